#pragma once

#include <Eigen/Core>

namespace mapproof {

/// Flips each column so that its leading entry is positive: the first entry whose size is within
/// 1e-8 of the column's largest, so that ties do not flip with rounding.
void fix_signs(Eigen::Ref<Eigen::MatrixXd> columns);

}  // namespace mapproof
