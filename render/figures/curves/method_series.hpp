#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/model/method.hpp"

namespace mapproof {

/// The style of a mapping method in all figures, as series_style() counts them. Two of the seven
/// colours' methods that share one differ in dash and marker; a method of others comes behind them.
std::size_t method_series(Method method);

/// The styles of a study's methods by their ids, the same in all figures of all studies: that of
/// the mapping method that an id names, with or without its parameter ("isomap", "isomap-K6"), or
/// of what mapproof's own studies compare. Ids that are not known come behind those, in their
/// order; if none is known, they have the first styles.
std::vector<std::size_t> series_of_methods(const std::vector<std::string>& ids);

}  // namespace mapproof
