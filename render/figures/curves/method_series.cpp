#include "render/figures/curves/method_series.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "render/figures/curves/error_lines.hpp"
#include "render/plot/short_names.hpp"

namespace mapproof {
namespace {

/// What studies compare besides mapproof's mapping methods.
struct Compared {
  std::size_t first = 0;  ///< The colour of its first id; the others have those behind it.
  std::vector<std::string_view> ids;  ///< At most as many as there are colours.
};

/// Each of them has ten styles of its own, behind those of the mapping methods.
const std::vector<Compared>& all_compared() {
  static const std::vector<Compared> all = {
      // association
      {3, {"given", "left-out", "estimated"}},
      // choice
      {6,
       {"stress", "residual-variance", "trustworthiness", "continuity", "stability", "anchors",
        "fixed", "combined", "random"}},
      // doubt and moved; what the figures of one method compare
      {1,
       {"slam", "permutations", "anchors-walls", "anchors-random", "anchors-cluster", "level-1",
        "level-2"}},
      // incremental, beside SMACOF, kNN weights and ISOMAP
      {7, {"smacof-whole", "smacof-knn-whole", "isomap-whole"}},
      // missing
      {6,
       {"pairwise-complete-smacof-knn", "pairwise-complete-isomap", "ppca-smacof-knn",
        "ppca-isomap", "pca-smacof-knn", "pca-isomap", "mean-smacof-knn", "ppca-expected",
        "covisible", "auto"}},
      // mixed
      {2,
       {"visibility", "visibility-order", "bearing", "bearing-order", "range", "range-order",
        "equal", "reliable", "joint"}},
      // submaps, beside SDE, ISOMAP and SMACOF, kNN weights
      {6,
       {"parts-smacof-knn", "parts-isomap", "parts-sde", "whole-smacof-knn-filled",
        "parts-smacof-knn-filled"}},
      // mrclam, a map per sensor and method
      {5,
       {"visibility-cmds", "visibility-isomap", "bearing-cmds", "bearing-isomap", "range-cmds",
        "range-isomap", "paths", "pairs-once", "pairs"}},
      // mrclam, wrong data association
      {0, {"swapped", "swapped-corrected", "misnamed", "misnamed-corrected"}}};
  return all;
}

/// The first style behind those of the mapping methods and of what topics compare.
std::size_t first_unknown() { return kMethodStyles + kSeriesCount * all_compared().size(); }

std::optional<std::size_t> series_of_compared(const std::string& id) {
  if (id == "fixed") return method_series(Method::kIsomap);  // It always takes the map of ISOMAP.
  constexpr std::string_view kWhole = "whole-";              // As sub-maps are not.
  if (id.starts_with(kWhole))
    if (const auto known = method_named(id.substr(kWhole.size()))) return method_series(*known);
  for (std::size_t g = 0; g < all_compared().size(); ++g) {
    const auto& [first, ids] = all_compared()[g];
    const auto found = std::ranges::find(ids, id);
    if (found == ids.end()) continue;
    const auto colour = (first + static_cast<std::size_t>(found - ids.begin())) % kSeriesCount;
    return kMethodStyles + kSeriesCount * g + colour;
  }
  return std::nullopt;
}

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
  return series_of_compared(method);
}

}  // namespace

std::size_t method_series(Method method) {
  // Behind all others, in the 21st round of colours, whose dashes are those of the first: landmark
  // ISOMAP has the colour that no other method on the neighbour graph has, landmark MVU that of
  // LPCA, which it is not compared with.
  constexpr std::size_t kRound = 20 * kSeriesCount;
  if (method == Method::kLandmarkIsomap) return kRound + 4;
  if (method == Method::kLandmarkMvu) return kRound;
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
  static_assert(kOrder.size() == kMethodStyles && kMethodStyles == kSeriesCount);
  return static_cast<std::size_t>(std::ranges::find(kOrder, method) - kOrder.begin());
}

bool is_mapping_method(const std::string& id) {
  return method_named(without_parameter(id)).has_value();
}

std::vector<std::size_t> series_of_methods(const std::vector<std::string>& ids,
                                           const std::vector<std::string>& labels,
                                           const std::vector<std::set<std::string>>& setups) {
  std::vector<std::size_t> series(ids.size()), known, left;
  const auto are_together = [&](std::size_t i, std::size_t j) {
    return setups.empty() || std::ranges::any_of(setups[i], [&](const std::string& setup) {
             return setups[j].contains(setup);
           });
  };
  const auto can_share = [&](std::size_t i, std::size_t j) {
    return labels[i] == labels[j] ||
           (without_parameters(labels[i]) == without_parameters(labels[j]) && !are_together(i, j));
  };
  std::map<std::size_t, std::vector<std::size_t>> owners;  // Of each known style.
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto style = series_of_id(ids[i]);
    if (!style || !std::ranges::all_of(owners[*style],
                                       [&](std::size_t owner) { return can_share(i, owner); })) {
      left.push_back(i);
      continue;
    }
    owners[*style].push_back(i);
    known.push_back(series[i] = *style);
  }
  const std::vector<std::size_t> free = free_series(known, left.size(), first_unknown());
  for (std::size_t k = 0; k < left.size(); ++k) series[left[k]] = free[k];
  return series;
}

}  // namespace mapproof
