#pragma once

#include <cstddef>

#include "core/model/method.hpp"

namespace mapproof {

/// The style of a mapping method in all figures, as series_style() counts them. Two of the seven
/// colours' methods that share one differ in dash and marker; a method of others comes behind them.
std::size_t method_series(Method method);

}  // namespace mapproof
