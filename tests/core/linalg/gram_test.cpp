#include "core/linalg/gram.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace mapproof {
namespace {

Eigen::MatrixXd noise(Eigen::Index rows, Eigen::Index columns) {
  Random random(5);
  return Eigen::MatrixXd::NullaryExpr(
      rows, columns, [&](Eigen::Index, Eigen::Index) { return random.uniform() - 0.5; });
}

/// One entry, summed as the header states: in order, over blocks of 256 columns, by fused
/// additions.
double plain(const Eigen::MatrixXd& X, Eigen::Index i, Eigen::Index j) {
  double total = 0.0;
  for (Eigen::Index first = 0; first < X.cols(); first += 256) {
    double sum = 0.0;
    for (Eigen::Index k = first; k < std::min(first + 256, X.cols()); ++k)
      sum = std::fma(X(i, k), X(j, k), sum);
    total += sum;
  }
  return total;
}

TEST(Gram, HasTheBitsOfAPlainLoopWhateverTheProcessor) {
  for (const Eigen::Index rows : {1, 5, 8, 49, 97, 200}) {
    const Eigen::MatrixXd X = noise(rows, 300);
    const Eigen::MatrixXd G = gram(X);
    for (Eigen::Index i = 0; i < rows; ++i)
      for (Eigen::Index j = 0; j < rows; ++j) EXPECT_EQ(G(i, j), plain(X, i, j)) << i << " " << j;
  }
}

TEST(Gram, OfAnEmptyMatrixIsEmpty) {
  EXPECT_EQ(gram(Eigen::MatrixXd(0, 0)).size(), 0);
  EXPECT_TRUE(gram(Eigen::MatrixXd(3, 0)).isZero());
}

}  // namespace
}  // namespace mapproof
