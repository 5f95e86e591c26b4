#include "core/linalg/gram.hpp"

#include <algorithm>

#include "core/linalg/packed_product.hpp"
#include "core/linalg/unset_matrix.hpp"

namespace mapproof {

using Eigen::Index;

void mirror_lower(Eigen::MatrixXd& matrix) {
  constexpr Index kBlock = 32;  // of both halves fits the first cache
  const Index n = matrix.rows();
  for (Index j0 = 0; j0 < n; j0 += kBlock)
    for (Index i0 = j0; i0 < n; i0 += kBlock)
      for (Index j = j0; j < std::min(j0 + kBlock, n); ++j)
        for (Index i = std::max(i0, j + 1); i < std::min(i0 + kBlock, n); ++i)
          matrix(j, i) = matrix(i, j);
}

Eigen::MatrixXd gram(const Eigen::MatrixXd& X) {
  const Index n = X.rows();
  Eigen::MatrixXd G = unset_matrix(n, n);
  G.setZero();
  add_gram(X, 1.0, G);
  mirror_lower(G);
  return G;
}

}  // namespace mapproof
