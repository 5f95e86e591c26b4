#pragma once

#include <Eigen/Core>

#include "core/base/huge_pages.hpp"

namespace mapproof {

/// An array whose entries are not set, for a function that sets them all; large ones in huge pages.
inline Eigen::MatrixXd unset_matrix(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(rows, columns);
  prefer_huge_pages(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
  return matrix;
}

}  // namespace mapproof
