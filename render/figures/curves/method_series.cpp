#include "render/figures/curves/method_series.hpp"

#include <algorithm>
#include <array>

namespace mapproof {

std::size_t method_series(Method method) {
  // There are seven colours: the last three methods take those of the first three, with other
  // dashes and markers. No two methods of one figure of the paper share a colour.
  constexpr std::array kOrder = {
      Method::kLpca,
      Method::kSde,
      Method::kIsomap,
      Method::kLle,
      Method::kSmacof,
      Method::kSmacofKnn,
      Method::kLaplacianEigenmap,
      Method::kHessianLle,
      Method::kKpcaGaussian,
      Method::kKpcaPolynomial,
  };
  return static_cast<std::size_t>(std::ranges::find(kOrder, method) - kOrder.begin());
}

}  // namespace mapproof
