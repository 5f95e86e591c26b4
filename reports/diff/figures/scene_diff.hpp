#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/diff/figures/figure_diff.hpp"

namespace mapproof {

/// What of a scene's file its comparison goes by.
struct SceneWords {
  std::vector<std::string> record_ids;
  bool varies = false;
};

/// Compares two ID.scene.json value by value: points, values and records are data; inks, sizes,
/// camera, lights, rules and labels are style; title, caption and alternative text metadata.
/// @param words  Set to the records of both.
/// @throws IoError with `name` and the place if one is not a scene.
FigureDiff scene_diff(std::string_view baseline, const std::string& baseline_name,
                      std::string_view current, const std::string& current_name,
                      const FigureOptions& options, SceneWords& words);

}  // namespace mapproof
