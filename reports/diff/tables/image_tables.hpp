#pragma once

#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// "1600 × 1200".
std::string size_text(const ImageSize& size);

/// Adds the comparison of the image files: sizes, pixels, clusters, SVG elements.
/// @param suffix     The end of the tables' ids.
/// @param secondary  Whether something else says what changed: a page then folds all of it but the
/// sizes.
void add_image_tables(std::vector<Block>& blocks, const std::vector<ImageFile>& files,
                      const std::string& suffix, bool secondary);

}  // namespace mapproof
