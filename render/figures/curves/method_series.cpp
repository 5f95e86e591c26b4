#include "render/figures/curves/method_series.hpp"

#include <algorithm>
#include <array>

namespace mapproof {

std::size_t method_series(Method method) {
  // There are seven colours: the last three take those of the first three, which are of the other
  // family, with other dashes and markers.
  constexpr std::array kOrder = {
      Method::kSmacofKnn,    Method::kSde,
      Method::kIsomap,       Method::kLle,
      Method::kHessianLle,   Method::kLaplacianEigenmap,
      Method::kSmacof,       Method::kLpca,
      Method::kKpcaGaussian, Method::kKpcaPolynomial,
  };
  return static_cast<std::size_t>(std::ranges::find(kOrder, method) - kOrder.begin());
}

}  // namespace mapproof
