#include "reports/diff/quantities.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

constexpr auto kLower = Direction::kLowerIsBetter;
constexpr auto kHigher = Direction::kHigherIsBetter;
constexpr auto kNeither = Direction::kNeither;

constexpr std::array kQuantities = {
    QuantityFacts{"mpe_m", "MPE", "m", kLower, {1e-6, 1e-6}},
    QuantityFacts{"moe_percent", "MOE", "%", kLower, {1e-9, 1e-6}},
    QuantityFacts{"mpe_all_fitted_m", "MPE fitted to all landmarks", "m", kLower, {1e-6, 1e-6}},
    QuantityFacts{"moe_unmirrored_percent", "MOE free of reflection", "%", kLower, {1e-9, 1e-6}},
    QuantityFacts{"stress", "stress", "", kLower, {1e-9, 1e-6}, true},
    QuantityFacts{"relative_gap", "relative gap", "", kLower, {1e-5, 0.0}, true},
    QuantityFacts{"iterations", "iterations", "", kNeither, {kInfinity, 0.0}},
    QuantityFacts{"landmark_m", "landmark", "m", kNeither, {1e-6, 1e-6}},
    QuantityFacts{"landmark_shape", "landmark", "of the spread", kNeither, {1e-6, 0.0}},
    QuantityFacts{"path_m", "position on the path", "m", kNeither, {1e-6, 1e-6}},
    QuantityFacts{"mean_m", "mean error of the path", "m", kLower, {1e-6, 1e-6}},
    QuantityFacts{"rmse_m", "root mean square error of the path", "m", kLower, {1e-6, 1e-6}},
    QuantityFacts{"last_tenth_m", "error in the last tenth", "m", kLower, {1e-6, 1e-6}},
    QuantityFacts{"best_tenth_m", "error in the best tenth", "m", kLower, {1e-6, 1e-6}},
    QuantityFacts{"worst_tenth_m", "error in the worst tenth", "m", kLower, {1e-6, 1e-6}},
    QuantityFacts{"landmarks_m", "mean error of landmarks", "m", kLower, {1e-6, 1e-6}},
    QuantityFacts{"range_scale", "range scale", "", kNeither, {1e-9, 1e-6}},
    QuantityFacts{"cost", "cost", "", kLower, {1e-9, 1e-6}, true},
    QuantityFacts{"observation_error", "error of the observations", "", kLower, {1e-9, 1e-6}},
    QuantityFacts{"positions_m", "mean error of positions", "m", kLower, {1e-6, 1e-6}},
    QuantityFacts{"sine", "sine of the canonical angle", "", kLower, {1e-9, 1e-6}},
    QuantityFacts{"loss", "value (less is better)", "", kLower, {1e-9, 1e-6}},
    QuantityFacts{"gain", "value (more is better)", "", kHigher, {1e-9, 1e-6}},
    QuantityFacts{"other", "other numbers of the records", "", kNeither, {1e-9, 1e-6}},
};

}  // namespace

std::span<const QuantityFacts> all_quantities() { return kQuantities; }

const QuantityFacts* find_quantity(std::string_view name) {
  const auto* found = std::ranges::find(kQuantities, name, &QuantityFacts::name);
  return found == kQuantities.end() ? nullptr : found;
}

Tolerance tolerance_of(const QuantityFacts& quantity, const Tolerances& changed) {
  const auto found = changed.find(quantity.name);
  return found == changed.end() ? quantity.tolerance : found->second;
}

std::string quantity_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("none");
}

std::pair<std::string, std::string> told_apart(double baseline, double current, int digits) {
  constexpr int kAll = 17;
  const auto text = [&](double value) {
    return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string("none");
  };
  while (digits < kAll && baseline != current && text(baseline) == text(current)) ++digits;
  return {text(baseline), text(current)};
}

std::string change_text(double baseline, double current, std::string_view unit) {
  const auto [from, to] = told_apart(baseline, current, 3);
  return fmt::format("{} \u2192 {}{}{}", from, to, unit.empty() ? "" : " ", unit);
}

}  // namespace mapproof
