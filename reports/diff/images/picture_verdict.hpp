#pragma once

#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/records/record_tie.hpp"

namespace mapproof {

/// Combines the judgement of a figure's value with what its images show. Without a value the images
/// alone decide.
/// @param has_value  Whether the figure's value was compared.
Judgement judge_pictures(const Judgement& value, bool has_value,
                         const std::vector<PictureFile>& pictures, const RecordContext& context);

}  // namespace mapproof
