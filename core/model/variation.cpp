#include "core/model/variation.hpp"

#include <array>

namespace mapproof {
namespace {

constexpr std::array kQuantities = {
    QuantityInfo{Quantity::kNoise, "noise", false, 0.0, 1000.0},
    QuantityInfo{Quantity::kDropoutShare, "dropout_share", false, 0.0, 0.99},
    QuantityInfo{Quantity::kAnchors, "anchors", true, 3.0, 1000.0},
    QuantityInfo{Quantity::kSmacofFall, "smacof_relative_fall", false, 0.0, 1.0},
    QuantityInfo{Quantity::kSmacofKnnFall, "smacof_knn_relative_fall", false, 0.0, 1.0},
    QuantityInfo{Quantity::kOnlySeenTogether, "only_seen_together", true, 0.0, 1.0},
};

}  // namespace

const QuantityInfo& info(Quantity quantity) {
  return kQuantities[static_cast<std::size_t>(quantity)];
}

std::optional<Quantity> quantity_named(std::string_view name) {
  for (const QuantityInfo& candidate : kQuantities)
    if (candidate.name == name) return candidate.quantity;
  return std::nullopt;
}

std::vector<std::string_view> quantity_names() {
  std::vector<std::string_view> names;
  for (const QuantityInfo& quantity : kQuantities) names.push_back(quantity.name);
  return names;
}

}  // namespace mapproof
