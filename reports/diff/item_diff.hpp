#pragma once

#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/figures/figure_diff.hpp"
#include "reports/diff/items.hpp"
#include "reports/diff/kept_heat_maps.hpp"
#include "reports/diff/records/record_tie.hpp"

namespace mapproof {

/// The content of a file with a 3-D figure.
struct SceneText {
  std::string text;
  std::string name;  ///< Of the file, for errors.
};

/// What the comparison of two 3-D figures needs besides their values.
struct SceneWords {
  std::vector<std::string> record_ids;
  bool varies = false;
};

/// Compares two ID.scene.json value by value. Points, values and records are data; colours, sizes,
/// camera, lights, rules and labels are style; title, caption and alternative text are metadata.
/// @param words  Set to the records of both.
/// @throws IoError with the file's name and the JSON pointer if one is not a 3-D figure.
FigureDiff scene_diff(const SceneText& baseline, const SceneText& current,
                      const FigureOptions& options, SceneWords& words);

/// The files of an item. Null if a side does not have it.
struct ItemSides {
  const ItemFiles* baseline = nullptr;
  const ItemFiles* current = nullptr;
};

/// Compares one figure or image: its value, then its images; then finds the cause.
/// @param room  For the heat maps of its images.
DiffItem item_diff(const std::string& id, const ItemSides& sides, const RecordContext& context,
                   const DiffSettings& settings, HeatMapRoom& room);

}  // namespace mapproof
