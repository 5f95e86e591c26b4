#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "reports/diff/figures/figure_diff.hpp"
#include "reports/diff/images/picture_diff.hpp"
#include "reports/diff/records/record_diff.hpp"

namespace mapproof {

/// A region of a picture that is not looked at.
struct IgnoredRegion {
  std::string id;  ///< Of the item; "*": all.
  PixelBox box;
};

/// What a comparison goes by.
struct DiffSettings {
  RecordOptions records;
  FigureOptions figures;
  PictureOptions pictures;
  std::vector<IgnoredRegion> ignored;
  std::vector<Verdict> allowed;

  /// The options for the pictures of one item, with its ignored regions.
  PictureOptions pictures_of(const std::string& id) const;
};

/// Reads mapproof-diff.json (docs/diff.md, docs/schemas/diff_settings.schema.json).
/// @throws IoError with file and JSON pointer, for unknown keys too.
DiffSettings parse_diff_settings(std::string_view text, const std::string& source);

}  // namespace mapproof
