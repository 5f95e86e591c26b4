#pragma once

#include <string>
#include <vector>

#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/error_curve.hpp"

namespace mapproof {

/// Findings for titles where no line is best (see best_line.hpp): what the means are, which is true
/// whether or not the intervals overlap; change_finding() also says whether they do.

/// What the last value of each line is compared with its first: "at 40° bearing noise, the MPE is
/// 1.0 times (LEM, 0.401 m) to 2.9 times (ISOMAP, 0.260 m) that at 0°". Empty if fewer than two
/// lines have both, the first above 0.
///
/// @param last, first  What a sentence calls the ends, "at 40° bearing noise" and "at 0°".
std::string change_finding(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                           const std::string& last, const std::string& first);

/// How much each method depends on its parameter: "the best K is 7 to 14 by method; the MPE depends
/// on it least with SMACOF kNN (worst 1.2 times the best), most with ISOMAP (2.8 times)". Empty if
/// fewer than two lines have two values, the least above 0.
///
/// @param names_best  Whether the values of the parameter with the least error are stated.
std::string dependence_finding(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                               const std::string& symbol, bool names_best);

/// Which placement is worst with the most anchors: "with 20 anchors, every method has its highest
/// MPE with placement “cluster”, 1.5 to 2.6 times its lowest". Empty if it is not the same one for
/// all methods.
std::string placement_finding(const std::vector<AnchorPanel>& panels);

}  // namespace mapproof
