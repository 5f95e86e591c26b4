#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "core/model/method.hpp"

namespace mapproof {

/// The style of a mapping method in all figures, as series_style() counts them. Yairi's ten methods
/// have a colour each; a method of others comes behind them.
std::size_t method_series(Method method);

/// Whether an id names a mapping method, with or without its parameter: "isomap", "isomap-K6".
bool is_mapping_method(const std::string& id);

/// The styles of a study's methods by their ids, the same in all figures of all studies: that of
/// the mapping method that an id names, with or without its parameter ("isomap", "isomap-K6"), or
/// of what mapproof's own studies compare. Ids that are not known have free_series() in their
/// order, as have further settings of a known method under another label that a figure may show
/// together: no two such labels have one style, and the first ten differ in colour. "ISOMAP, K = 6"
/// and "ISOMAP, K = 9" of different setups have one.
/// @param labels  As many as ids.
/// @param setups  Of each id, those in which it has results; none at all: all are shown together.
std::vector<std::size_t> series_of_methods(const std::vector<std::string>& ids,
                                           const std::vector<std::string>& labels,
                                           const std::vector<std::set<std::string>>& setups = {});

/// Of methods that are called as their ids.
inline std::vector<std::size_t> series_of_methods(const std::vector<std::string>& ids) {
  return series_of_methods(ids, ids);
}

}  // namespace mapproof
