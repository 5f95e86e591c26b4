#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// A quantity over two factors.
struct HeatMapSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string x_label, y_label;               ///< Of the factors, with their units.
  std::vector<std::string> x_names, y_names;  ///< Of their levels, ascending.
  /// One per combination: row by row, the rows in the order of `y_names`; NaN: missing.
  std::vector<double> values;
  /// Whether values above kGreatestError_m are of maps that diverged: their cells say so, and
  /// colours go as far as those of the others need.
  bool great_errors = false;
  std::optional<Range> shared_span = {};  ///< Colours show these values, too, as other maps' do.
  /// Of the numbers in the cells: rounded_text(); of logarithmic colours, at most, and three
  /// digits.
  int decimals = 3;
  std::string quantity;              ///< "MPE".
  std::string unit;                  ///< "m"; may be empty.
  std::string missing = "no value";  ///< What a hatched cell means.
  std::vector<std::string> record_ids;
};

/// Coloured cells of one size with their numbers and a colour bar, the first levels at the lower
/// left; missing ones are hatched, with a note. The colours are viridis, whose lightness
/// rises evenly: along the logarithm where the values, all positive, span more than a factor of 10
/// and are not percentages.
/// @throws InvalidInput if values and levels differ in number or no value is there.
Figure heat_map_figure(const HeatMapSpec& spec);

/// Which factor changes the values more, as a title: "MPE depends more on side of the room than on
/// landmarks, between 0.04 m and 0.36 m". Where no factor is clear, the title says where the values
/// are least and greatest: "lowest MPE 0.04 m at 50 and 1.5 m, highest 0.36 m at 80 and 4 m", first
/// the level of x. @param quantity  In a sentence.
/// @throws InvalidInput as above.
std::string heat_map_finding(const HeatMapSpec& spec, const std::string& quantity);

}  // namespace mapproof
