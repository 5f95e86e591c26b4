#pragma once

#include <string>
#include <vector>

#include "render/figures/curves/error_lines.hpp"

namespace mapproof {

/// How the title of a figure names what its lines show.
struct LineQuantity {
  std::string label = "MPE";  ///< In a sentence.
  std::string unit = "m";     ///< May be empty.
  bool lower_is_better = true;
};

/// What x is.
struct LineAxis {
  std::string name;
  std::string unit = {};
};

/// Of the label of an axis: "noise of bearings [°]".
LineAxis line_axis(const std::string& label);

/// Which line is best at the last x, as a title: "SDE has the lowest MPE after 2000 observations,
/// 0.14 m". Lines whose intervals overlap its own are named with it. Empty if nothing is known.
///
/// @param where  "after {} observations", with {} for x.
std::string best_at_end(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                        const std::string& where);

/// Which line is best over the whole axis: "ISOMAP has the lowest MPE throughout", "LPCA has the
/// lowest MPE at noise = 0, HLLE at 20"; of one line, where it is best. Empty if nothing is known,
/// or lines are equal where they are best.
std::string best_over(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                      const LineAxis& axis);

/// Which line has the best value of all, and at which x: "SDE has the lowest MPE, 0.14 m at K = 7".
/// Empty if nothing is known.
std::string best_of_all(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                        const LineAxis& axis);

}  // namespace mapproof
