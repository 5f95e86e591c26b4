#include "core/results/quantity.hpp"

#include <array>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestName = 100;

constexpr std::array kBetterNames = {std::pair(Better::kLower, "lower"),
                                     std::pair(Better::kHigher, "higher"),
                                     std::pair(Better::kNeither, "neither")};

/// Roundings: of lengths, of numbers without one, of what a tolerance of the solver decides.
constexpr Tolerance kLength{1e-6, 1e-6};
constexpr Tolerance kNumber{1e-9, 1e-6};

std::vector<Quantity> dictionary() {
  using enum NightlyRule;
  constexpr auto kLower = Better::kLower;
  constexpr auto kHigher = Better::kHigher;
  constexpr auto kNeither = Better::kNeither;
  return {
      {"mpe_m", "MPE", "m", kLower, kLength, kRatio},
      {"moe_percent", "MOE", "%", kLower, kNumber, kPoints},
      {"mpe_all_fitted_m", "MPE fitted to all landmarks", "m", kLower, kLength, kKept},
      {"moe_unmirrored_percent", "MOE, reflection allowed", "%", kLower, kNumber, kPoints, false,
       "moe_percent"},
      {"stress", "stress", "", kLower, kNumber, kNone, true},
      {"relative_gap", "relative gap", "", kLower, {1e-5, 0.0}, kNone, true},
      {"iterations", "iterations", "", kNeither, {kInfinity, 0.0}, kNone},
      {"landmark_m", "landmark", "m", kNeither, kLength, kNone},
      {"landmark_shape", "landmark", "of the spread", kNeither, {1e-6, 0.0}, kNone},
      {"path_m", "position on the path", "m", kNeither, kLength, kNone},
      {"path_mean_m", "mean error of the path", "m", kLower, kLength, kRatio},
      {"path_rmse_m", "RMS error of the path", "m", kLower, kLength, kKept},
      {"last_tenth_m", "error in the last tenth", "m", kLower, kLength, kKept},
      {"best_tenth_m", "error in the best tenth", "m", kLower, kLength, kKept},
      {"worst_tenth_m", "error in the worst tenth", "m", kLower, kLength, kKept},
      {"landmarks_m", "mean error of landmarks", "m", kLower, kLength, kRatio},
      {"range_scale", "range scale", "", kNeither, kNumber, kKept},
      {"cost", "cost", "", kLower, kNumber, kNone, true},
      {"observation_error", "error of the observation matrix", "", kLower, kNumber, kRatio},
      {"positions_m", "mean error of positions", "m", kLower, kLength, kRatio},
      {"sine", "sine of the canonical angle", "", kLower, kNumber, kKept},
      {"fit_verdict", "verdict on the fit, 1: fits to 4: does not", "", kLower, kNumber, kRatio},
      {"fit_chi2_ratio", "squared residuals over those expected from the noise", "", kLower,
       kNumber, kRatio},
      {"fit_outliers_percent", "estimated share of gross outliers", "%", kNeither, kNumber, kKept},
      {"fit_scatter_m", "scatter of a measured distance", "m", kNeither, kLength, kKept},
      {"fit_known_misfit_m", "misfit to given positions", "m", kLower, kLength, kRatio},
      {"fit_range_sigma_m", "noise of a range", "m", kNeither, kLength, kKept},
      {"fit_forward_sigma_m", "noise of odometry after 1 m", "m", kNeither, kLength, kKept},
      {"fit_heading_sigma_rad", "noise of the heading after 1 m", "rad", kNeither, kNumber, kKept},
      {"fit_held_out_nats", "log-likelihood of a held-out range", "nats", kHigher, kNumber, kKept},
      {"fit_repaired_held_out_nats", "the same of the repaired map", "nats", kHigher, kNumber,
       kKept},
      {"seconds", "seconds", "s", kLower, kNumber, kDuration},
  };
}

std::string facts_of(const Quantity& quantity) {
  return fmt::format(
      "{}, {}", quantity.unit.empty() ? "without a unit" : "in " + printable(quantity.unit, 40),
      quantity.better == Better::kNeither ? std::string("neither way better")
                                          : fmt::format("{} is better", name(quantity.better)));
}

bool is_the_same(const Quantity& a, const Quantity& b) {
  return a.unit == b.unit && a.better == b.better;
}

}  // namespace

std::string_view name(Better better) {
  for (const auto& [known, text] : kBetterNames)
    if (known == better) return text;
  return "";
}

std::optional<Better> better_named(std::string_view name) {
  for (const auto& [better, text] : kBetterNames)
    if (name == text) return better;
  return std::nullopt;
}

std::span<const Quantity> all_quantities() {
  static const std::vector<Quantity> all = dictionary();
  return all;
}

const Quantity* find_quantity(std::string_view id) {
  const std::span<const Quantity> all = all_quantities();
  const auto found = std::ranges::find(all, id, &Quantity::id);
  return found == all.end() ? nullptr : &*found;
}

const Quantity& known_quantity(std::string_view id) { return Quantities().at(id); }

bool is_quantity_id(std::string_view id) {
  const auto is_in = [&](std::string_view known) {
    return id.find_first_not_of(known) == std::string_view::npos;
  };
  return !id.empty() && id.size() <= kLongestName && id.front() >= 'a' && id.front() <= 'z' &&
         is_in("abcdefghijklmnopqrstuvwxyz0123456789_");
}

std::string problem_of(const Quantity& quantity) {
  if (!is_quantity_id(quantity.id))
    return fmt::format(
        "the id of a quantity is lower-case letters, digits and '_' and begins with a letter, not "
        "\"{}\"",
        printable(quantity.id, 40));
  if (quantity.label.empty()) return fmt::format("the quantity \"{}\" needs a label", quantity.id);
  for (const std::string& text : {quantity.label, quantity.unit})
    if (printable(text, kLongestName) != text)
      return fmt::format(
          "the quantity \"{}\" has a label or unit that is too long or holds hidden "
          "characters: \"{}\"",
          quantity.id, printable(text, 40));
  const Quantity* known = find_quantity(quantity.id);
  if (known != nullptr && !is_the_same(*known, quantity))
    return fmt::format("\"{}\" is a quantity of mapproof's, {}; it is declared {} here",
                       quantity.id, facts_of(*known), facts_of(quantity));
  return "";
}

Quantity study_quantity(std::string id, std::string label, std::string unit, Better better) {
  Quantity quantity{.id = std::move(id), .label = {}, .unit = std::move(unit), .better = better};
  quantity.label = label;
  if (const std::string problem = problem_of(quantity); !problem.empty())
    throw InvalidInput(problem);
  if (better != Better::kNeither)
    quantity.nightly = quantity.unit == "%" ? NightlyRule::kPoints : NightlyRule::kRatio;
  if (const Quantity* known = find_quantity(quantity.id)) quantity = *known;
  quantity.label = std::move(label);
  return quantity;
}

void Quantities::declare(const Quantity& quantity) {
  if (const std::string problem = problem_of(quantity); !problem.empty())
    throw InvalidInput(problem);
  if (const Quantity* known = find(quantity.id)) {
    if (!is_the_same(*known, quantity))
      throw InvalidInput(fmt::format("the quantity \"{}\" is declared twice, {} and {}",
                                     quantity.id, facts_of(*known), facts_of(quantity)));
    return;
  }
  declared_.insert(std::ranges::upper_bound(declared_, quantity.id, {}, &Quantity::id), quantity);
}

const Quantity* Quantities::find(std::string_view id) const {
  if (const Quantity* known = find_quantity(id)) return known;
  const auto found = std::ranges::find(declared_, id, &Quantity::id);
  return found == declared_.end() ? nullptr : &*found;
}

const Quantity& Quantities::at(std::string_view id) const {
  const Quantity* found = find(id);
  if (found == nullptr)
    throw InvalidInput("there is no quantity \"" + printable(std::string(id), 40) + "\"");
  return *found;
}

std::vector<Quantity> Quantities::all() const {
  std::vector<Quantity> all(all_quantities().begin(), all_quantities().end());
  std::ranges::copy(declared_, std::back_inserter(all));
  return all;
}

std::string label_with_unit(const Quantity& quantity) {
  return quantity.unit.empty() ? quantity.label : quantity.label + " [" + quantity.unit + "]";
}

std::size_t dictionary_rank(const Quantity& quantity) {
  const std::span<const Quantity> all = all_quantities();
  const auto found = std::ranges::find(all, quantity.id, &Quantity::id);
  return static_cast<std::size_t>(found - all.begin());
}

}  // namespace mapproof
