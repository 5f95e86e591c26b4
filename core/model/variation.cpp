#include "core/model/variation.hpp"

#include <array>

namespace mapproof {
namespace {

constexpr std::array kFactors = {
    FactorInfo{Factor::kNoise, "noise", false, 0.0, 1000.0},
    FactorInfo{Factor::kDropoutShare, "dropout_share", false, 0.0, 0.99},
    FactorInfo{Factor::kAnchors, "anchors", true, 3.0, 1000.0},
    FactorInfo{Factor::kSmacofFall, "smacof_relative_fall", false, 0.0, 1.0},
    FactorInfo{Factor::kSmacofKnnFall, "smacof_knn_relative_fall", false, 0.0, 1.0},
    FactorInfo{Factor::kOnlySeenTogether, "only_seen_together", true, 0.0, 1.0},
};

}  // namespace

const FactorInfo& info(Factor factor) { return kFactors[static_cast<std::size_t>(factor)]; }

std::optional<Factor> factor_named(std::string_view name) {
  for (const FactorInfo& candidate : kFactors)
    if (candidate.name == name) return candidate.factor;
  return std::nullopt;
}

std::vector<std::string_view> factor_names() {
  std::vector<std::string_view> names;
  for (const FactorInfo& factor : kFactors) names.push_back(factor.name);
  return names;
}

}  // namespace mapproof
