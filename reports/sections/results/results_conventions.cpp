#include "reports/sections/results/results_conventions.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text/ascii.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/diagrams/value_dots.hpp"
#include "render/figures/unit_scale.hpp"

namespace mapproof {

std::string id_below(const std::string& block, std::string what) {
  std::ranges::replace(what, '_', '-');
  return bounded_id(block + "-" + what, kLongestId);
}

std::string summary_id(const std::string& study) { return study + "-summary"; }

std::string key_of(std::size_t line) { return fmt::format("line-{}", line + 1); }

std::string record_of(const ResultsBlock& block) { return block.conditions.front().setup; }

std::string value_words(double value, const std::string& unit, bool great_errors) {
  if (const auto power = power_of(unit)) return significant(value * std::pow(10.0, *power));
  const bool diverged = great_errors && std::abs(value) > greatest_error(unit);
  return diverged ? error_text(value) : quantity_text(value, unit);
}

std::string lone_value(double value, const Quantity& quantity, bool great_errors) {
  const ScaledUnit unit =
      quantity.unit == "m" ? ScaledUnit{quantity.unit} : scaled_unit(quantity, std::abs(value));
  return value_words(unit.factor * value, unit.unit, great_errors);
}

std::string range_title(const std::string& range, const std::string& diverged,
                        const std::string& not_ranked) {
  std::string text = diverged.empty() ? range : range + "; " + diverged;
  if (!not_ranked.empty()) text += (diverged.empty() ? ", " : "; ") + not_ranked;
  return text;
}

bool spans_widely(const std::vector<double>& values) {
  if (values.empty()) return false;
  const auto [least, greatest] = std::ranges::minmax(values);
  return least > 0.0 && greatest > kWideSpan * least;
}

bool is_known(double value) { return std::isfinite(value); }

std::string in_sentence(std::string label) {
  if (const std::size_t comma = label.find(", "); comma != std::string::npos)
    label = fmt::format("{} ({})", label.substr(0, comma), label.substr(comma + 2));
  const std::string rest = label.substr(std::min<std::size_t>(1, label.size()));
  const std::string_view word = std::string_view(rest).substr(0, rest.find(' '));
  const bool is_name = word.empty() || word.front() == '-' || lower_case(word) != word ||
                       std::ranges::any_of(word, is_digit);
  if (is_name) return label;
  return lower_case(label.substr(0, 1)) + label.substr(1);
}

std::optional<double> aim_of(const Quantity& quantity) {
  return quantity.id.ends_with("_covered_percent") ? std::optional(95.0) : std::nullopt;
}

bool has_better_side(const Quantity& quantity) {
  return quantity.better != Better::kNeither && !aim_of(quantity);
}

bool is_distance_from_another(const Quantity& quantity) {
  return quantity.id.starts_with("gap_") || quantity.id.starts_with("greatest_gap_");
}

}  // namespace mapproof
