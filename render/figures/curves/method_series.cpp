#include "render/figures/curves/method_series.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "render/figures/curves/error_lines.hpp"

namespace mapproof {
namespace {

/// What studies of mapproof compare besides its mapping methods, those of one study together.
constexpr std::string_view kCompared[] = {
    // association
    "given", "left-out", "estimated",
    // choice
    "stress", "residual-variance", "trustworthiness", "continuity", "stability", "anchors",
    "combined", "fixed", "random",
    // doubt and moved
    "slam", "permutations",
    // incremental
    "smacof-whole", "smacof-knn-whole", "isomap-whole",
    // missing
    "pairwise-complete-smacof-knn", "pairwise-complete-isomap", "ppca-smacof-knn", "ppca-isomap",
    "pca-smacof-knn", "pca-isomap", "mean-smacof-knn", "ppca-expected", "covisible", "auto",
    // mixed
    "visibility", "visibility-order", "bearing", "bearing-order", "range", "range-order", "equal",
    "reliable", "joint",
    // submaps
    "whole-smacof-knn", "whole-isomap", "whole-sde", "parts-smacof-knn", "parts-isomap",
    "parts-sde", "whole-smacof-knn-filled", "parts-smacof-knn-filled",
    // mrclam
    "visibility-cmds", "visibility-isomap", "bearing-cmds", "bearing-isomap", "range-cmds",
    "range-isomap", "paths", "pairs-once", "pairs", "swapped", "swapped-corrected", "misnamed",
    "misnamed-corrected"};

/// "isomap-K6" as "isomap": a method is the same with any value of its parameter.
std::string without_parameter(const std::string& id) {
  for (const MethodInfo& method : all_methods()) {
    if (!method.parameter) continue;
    const std::string sign = "-" + std::string(method.parameter->symbol);
    const std::size_t at = id.find(sign);
    if (at == std::string::npos || at + sign.size() == id.size()) continue;
    std::size_t value = at + sign.size();
    if (id[value] == '-') ++value;  // "sigma2-10".
    const std::size_t end = std::min(id.find_first_not_of("0123456789.e+", value), id.size());
    if (end > value) return id.substr(0, at) + id.substr(end);
  }
  return id;
}

std::optional<std::size_t> series_of_id(const std::string& id) {
  const std::string method = without_parameter(id);
  if (const auto known = method_named(method)) return method_series(*known);
  const auto compared = std::ranges::find(kCompared, method);
  if (compared == std::end(kCompared)) return std::nullopt;
  return kMethodStyles + static_cast<std::size_t>(compared - std::begin(kCompared));
}

}  // namespace

std::size_t method_series(Method method) {
  // Behind all others, whose styles stay; Landmark ISOMAP has the colour that no other method on the
  // neighbour graph has, landmark MVU that of HLLE, which it is not compared with.
  constexpr std::size_t kOfLandmarkIsomap = 4 + 7 * 100, kOfLandmarkMvu = 7 * 100;
  if (method == Method::kLandmarkIsomap) return kOfLandmarkIsomap;
  if (method == Method::kLandmarkMvu) return kOfLandmarkMvu;
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
  static_assert(kOrder.size() == kMethodStyles);
  return static_cast<std::size_t>(std::ranges::find(kOrder, method) - kOrder.begin());
}

std::vector<std::size_t> series_of_methods(const std::vector<std::string>& ids) {
  std::vector<std::size_t> series;
  const bool any_known =
      std::ranges::any_of(ids, [](const std::string& id) { return series_of_id(id).has_value(); });
  const std::size_t behind = any_known ? kMethodStyles + std::size(kCompared) : 0;
  for (std::size_t i = 0; i < ids.size(); ++i)
    series.push_back(series_of_id(ids[i]).value_or(behind + i));
  return series;
}

}  // namespace mapproof
