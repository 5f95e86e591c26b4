#pragma once

#include <array>

namespace mapproof::figure_json {

// The names of enumerators in files, in the order of the enumerators.
inline constexpr std::array kInks = {"text",    "muted",   "warning", "series1", "series2",
                                     "series3", "series4", "series5", "series6", "series7"};
inline constexpr std::array kDashes = {"solid", "dashed", "dotted", "dash-dot", "long-dash"};
inline constexpr std::array kMarkers = {"none",    "circle",        "square", "triangle",
                                        "diamond", "triangle-down", "cross",  "plus"};
inline constexpr std::array kFills = {"none", "tint", "solid", "paper"};
inline constexpr std::array kRamps = {"ink", "viridis"};
inline constexpr std::array kAligns = {"start", "middle", "end"};
inline constexpr std::array kScales = {"linear", "log"};

}  // namespace mapproof::figure_json
