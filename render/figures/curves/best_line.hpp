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
  std::vector<std::string> plural = {};  ///< Labels of lines that stand for several.
  std::string family = {};  ///< "these 5", of a study with more methods; empty: all are shown.
  bool great_errors = true;  ///< As in ErrorLinesSpec: what diverged ties with no other value.

  /// Whether a value is that of a map that diverged.
  bool has_diverged(double value) const;
};

/// An x without its name where the unit says what it is: "10°", but "K = 7" and, of a quantity in
/// the same unit, "noise = 10 %".
std::string x_text(const LineAxis& axis, double x, const LineQuantity& quantity);

/// A label short and without its parameter: "SMACOF kNN" of "SMACOF, kNN weights, K = 7".
std::string name_alone(const std::string& label);

/// How a sentence names a line: as name_alone(), with the parameter if another line is then alike.
std::string line_name(const ErrorLine& line, const std::vector<ErrorLine>& lines);

/// "an MPE", "a drift", "an RPE".
std::string with_article(const std::string& label);

/// Which line is best at the last x, as a title: "SDE has the lowest MPE after 2000 observations,
/// 0.14 m". Lines that tie with it, as of best_over(), are named with it; where they are more than
/// three, or all there are, between which values: "after 2000 observations, 4 of 5 methods have an
/// MPE of 0.19 m to 0.23 m, LEM 0.40 m". A family is named: "of these 5, SDE has the lowest MPE".
/// Names are short, without parameters that tell no two lines apart. Empty if nothing is known.
///
/// @param where  "after {} observations", with {} for x.
std::string best_at_end(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                        const std::string& where);

/// How many lines tie for the best at the last x, as of best_over(), the best among them; 0 if
/// nothing is known.
std::size_t ties_at_end(const std::vector<ErrorLine>& lines, const LineQuantity& quantity);

/// Which line is best over the whole axis: "ISOMAP has the lowest MPE throughout", "LPCA has the
/// lowest MPE at noise = 0, HLLE at 20"; of one line, where it is best. Lines tie where the paired
/// test or, without one, their intervals do not tell them from the best, or their digits shown are
/// equal: "ISOMAP has the lowest MPE at 10°; elsewhere
/// it ties with others", "ISOMAP ties for the lowest MPE throughout". "Throughout" is said of no
/// line that ties at some x by its own wide interval alone; where no line is the best or drawn as
/// low as it throughout: "SDE has the lowest mean MPE at 5 of 7 points, where it ties with others".
/// Empty if nothing is known, if all lines tie, or if more than three lines are best wherever they
/// differ.
std::string best_over(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                      const LineAxis& axis);

/// "odometry over 1 km", "2 methods over 1 km at some points": what a title that gives the range of
/// the other values says of lines that diverged; those of one label, as of several panels, are one.
/// Empty if none did, or if all values did.
std::string diverged_words(const std::vector<ErrorLine>& lines, const LineQuantity& quantity);

/// Whether the intervals of a line's first and last known values overlap.
bool ends_tie(const ErrorLine& line);

/// Whether the intervals of two known values of a line, by their indices, overlap.
bool intervals_overlap(const ErrorLine& line, std::size_t i, std::size_t k);

/// Which line has the best value of all, and at which x: "SDE has the lowest MPE, 0.14 m at K = 7".
/// Empty if nothing is known, or another line ties with it: by the paired test of the points that
/// have one, else at any x.
std::string best_of_all(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                        const LineAxis& axis);

/// Which line is best, and ties with none, at the most points of several panels: "ISOMAP has the
/// lowest MPE at 7 of 9 points", "at all points", and at a single one "SDE has the lowest MPE, 0.14
/// m". Points at which its mean is the best but intervals overlap count, too. The title says how
/// many they are: "at all 9 points; intervals overlap at 2". Empty if nothing is known, if two
/// lines are best equally often, or if none is best without a tie at more than half of the points.
std::string best_of_points(const std::vector<std::vector<ErrorLine>>& panels,
                           const LineQuantity& quantity);

}  // namespace mapproof
