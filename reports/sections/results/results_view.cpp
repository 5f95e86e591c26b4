#include "reports/sections/results/results_view.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/base/median.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/method_series.hpp"

namespace mapproof {
namespace {

bool is_number(const Level& level) { return std::holds_alternative<double>(level.value); }

/// The factor along which a setup's curves go: of those with several levels one whose levels are
/// all numbers before others, the one with the most levels first. Empty if no factor varies.
std::string axis_of(const std::set<Condition>& conditions) {
  std::map<std::string, std::set<Level>> factors;
  for (const Condition& at : conditions)
    for (const Level& level : at.levels) factors[level.factor].insert(level);
  std::string axis;
  std::pair<bool, std::size_t> best{false, 1};
  for (const auto& [factor, levels] : factors) {
    const std::pair<bool, std::size_t> rank{std::ranges::all_of(levels, is_number), levels.size()};
    if (levels.size() > 1 && (axis.empty() || rank > best)) {
      axis = factor;
      best = rank;
    }
  }
  return axis;
}

}  // namespace

bool ResultsBlock::has_axis() const {
  return !factor.empty() && std::ranges::all_of(levels, is_number);
}

namespace {

/// By how much short times are multiplied, so that a reader sees "141 µs" in place of "0.000141 s";
/// and their unit.
std::pair<double, std::string> scale_of_seconds(std::vector<double> seconds) {
  std::erase_if(seconds, [](double value) { return is_lost(value) || value == 0.0; });
  if (seconds.empty()) return {1.0, "s"};
  for (double& value : seconds) value = std::abs(value);
  const double middle = median(seconds);
  return middle < 1e-3  ? std::pair(1e6, std::string("µs"))
         : middle < 0.1 ? std::pair(1e3, std::string("ms"))
                        : std::pair(1.0, std::string("s"));
}

}  // namespace

ResultsView::ResultsView(const ResultsStudy& study) : study_(study) {
  std::map<std::string, std::pair<double, std::string>> scales;  // By quantity.
  for (const std::string& id : study.quantities) {
    if (study.results.quantities.at(id).unit != "s") continue;
    std::vector<double> seconds;
    for (const Result& row : study.results.rows)
      if (row.quantity == id) seconds.push_back(row.value);
    scales[id] = scale_of_seconds(std::move(seconds));
  }
  std::vector<std::string> ids;
  for (const Label& method : study.methods) ids.push_back(method.id);
  series_ = series_of_methods(ids);
  for (const Result& row : study.results.rows) {
    const Key key{row.at, {row.method, row.quantity}};
    groups_[row.run] = row.group;
    clusters_.try_emplace(row.group, static_cast<int>(clusters_.size()));
    if (is_lost(row.value)) {
      lost_[key].insert(row.run);
      continue;
    }
    const auto scale = scales.find(row.quantity);
    const double value = scale == scales.end() ? row.value : scale->second.first * row.value;
    auto& [sum, count] = sums_[key][row.run];
    sum += value;
    ++count;
    auto& [least, greatest] = ranges_.try_emplace(row.quantity, value, value).first->second;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  for (const std::string& id : study.quantities) {
    Quantity quantity = study.results.quantities.at(id);
    const auto label = std::ranges::find(study.quantity_labels, id, &Label::id);
    if (label != study.quantity_labels.end()) quantity.label = label->label;
    if (const auto scale = scales.find(id); scale != scales.end())
      quantity.unit = scale->second.second;
    quantities_.emplace(id, std::move(quantity));
  }
  for (const RunOutcome& outcome : study.results.outcomes)
    outcomes_[{outcome.at, outcome.method}].push_back(&outcome);
  make_blocks();
  make_overviews();
}

void ResultsView::make_blocks() {
  for (const Label& setup : study_.setups) add_setup(setup);
  std::set<std::string> ids;
  for (ResultsBlock& block : blocks_) {
    const std::string id = block.id;
    for (int i = 2; !ids.insert(block.id).second; ++i) block.id = fmt::format("{}-{}", id, i);
  }
}

void ResultsView::add_setup(const Label& setup) {
  std::set<Condition> conditions;
  for (const Result& row : study_.results.rows)
    if (row.at.setup == setup.id) conditions.insert(row.at);
  const std::string axis = axis_of(conditions);
  std::set<std::string> factors;
  for (const Condition& at : conditions)
    for (const Level& level : at.levels) factors.insert(level.factor);
  std::map<std::pair<Condition, bool>, ResultsBlock> blocks;  // By the other levels; with the axis?
  for (const Condition& at : conditions) {
    Condition others = at;
    const auto on_axis = std::ranges::find(others.levels, axis, &Level::factor);
    const bool has_axis = on_axis != others.levels.end();
    std::optional<Level> level;
    if (has_axis) {
      level = *on_axis;
      others.levels.erase(on_axis);
    }
    ResultsBlock& block = blocks[{others, has_axis}];
    if (level) block.levels.push_back(*level);
    block.conditions.push_back(at);
    if (block.conditions.size() > 1) continue;
    block.factor = has_axis ? axis : "";
    block.title = setup.label.empty() ? study_.title : setup.label;
    block.id = study_.name + "-" + slug_of(setup.id.empty() ? "all" : setup.id);
    block.others = others.levels;
    for (const Level& other : others.levels) {
      block.title += ", " + level_words(other);
      block.id += "-" + slug_of(other.factor) + "-" + level_slug(other);
    }
    for (const std::string& factor : factors)
      if (std::ranges::find(at.levels, factor, &Level::factor) == at.levels.end()) {
        block.title += ", without " + label_of(study_.factors, factor);
        block.id += "-without-" + slug_of(factor);
      }
    if (block.id.back() == '-') block.id += "setup";
    block.id = bounded_id(std::move(block.id), 80);
  }
  for (auto& [others, block] : blocks) blocks_.push_back(std::move(block));
}

void ResultsView::make_overviews() {
  // Blocks of one setup, of one factor, that give levels of the same other factors.
  using Likeness = std::tuple<std::string, std::string, std::vector<std::string>>;
  std::vector<std::pair<Likeness, std::vector<const ResultsBlock*>>> alike;
  for (const ResultsBlock& block : blocks_) {
    std::vector<std::string> others;
    for (const Level& level : block.others) others.push_back(level.factor);
    const Likeness likeness{block.conditions.front().setup, block.factor, others};
    auto found = std::ranges::find(alike, likeness, &decltype(alike)::value_type::first);
    if (found != alike.end())
      found->second.push_back(&block);
    else
      alike.push_back({likeness, {&block}});
  }
  for (const auto& [likeness, blocks] : alike)
    if (blocks.size() > 1)
      if (auto overview = overview_of(blocks)) overviews_.push_back(*std::move(overview));
}

std::optional<ResultsOverview> ResultsView::overview_of(
    const std::vector<const ResultsBlock*>& blocks) const {
  ResultsOverview overview;
  overview.blocks = blocks;
  std::vector<std::size_t> varying;
  std::vector<std::string> factors;
  for (std::size_t i = 0; i < blocks.front()->others.size(); ++i)
    if (std::ranges::any_of(blocks, [&](const ResultsBlock* block) {
          return block->others[i] != blocks.front()->others[i];
        })) {
      varying.push_back(i);
      factors.push_back(label_of(study_.factors, blocks.front()->others[i].factor));
    }
  overview.factors = listed(factors, factors.size() + 1);
  for (const ResultsBlock* block : blocks) {
    std::string& name = overview.names.emplace_back();
    for (const std::size_t i : varying)
      name += (name.empty() ? "" : ", ") + short_words(block->others[i]);
  }
  const std::string setup = blocks.front()->conditions.front().setup;
  const std::string label = label_of(study_.setups, setup);
  overview.title = (label.empty() ? study_.title : label) + ": overview by " + overview.factors;
  overview.id = study_.name + "-overview-" + slug_of(setup.empty() ? "all" : setup);
  while (std::ranges::any_of(overviews_,
                             [&](const ResultsOverview& other) { return other.id == overview.id; }))
    overview.id += "-more";
  if (blocks.front()->factor.empty()) {
    for (const ResultsBlock* block : blocks)
      overview.conditions.push_back(block->conditions.front());
    return overview;
  }
  const std::vector<Level>& levels = blocks.front()->levels;
  const auto is_everywhere = [&](const Level& level) {
    return std::ranges::all_of(blocks, [&](const ResultsBlock* block) {
      return std::ranges::find(block->levels, level) != block->levels.end();
    });
  };
  const auto last = std::find_if(levels.rbegin(), levels.rend(), is_everywhere);
  if (last == levels.rend()) return std::nullopt;
  overview.level = *last;
  for (const ResultsBlock* block : blocks) {
    const auto at = std::ranges::find(block->levels, *last) - block->levels.begin();
    overview.conditions.push_back(block->conditions[static_cast<std::size_t>(at)]);
  }
  return overview;
}

std::vector<const Quantity*> ResultsView::quantities(const ResultsBlock& block) const {
  std::vector<const Quantity*> found;
  for (const std::string& id : study_.quantities) {
    const Quantity& quantity = this->quantity(id);
    if (!lines(block, quantity).empty()) found.push_back(&quantity);
  }
  return found;
}

bool ResultsView::has_great_errors(const Quantity& quantity) const {
  return quantity.unit == "m" && quantity.better == Better::kLower &&
         std::ranges::any_of(study_.results.rows, [&](const Result& row) {
           return row.quantity == quantity.id && row.value <= kGreatestError_m;
         });
}

std::vector<ResultsLine> ResultsView::lines(const ResultsBlock& block,
                                            const Quantity& quantity) const {
  std::vector<ResultsLine> lines;
  for (std::size_t i = 0; i < study_.methods.size(); ++i) {
    const Label& method = study_.methods[i];
    std::set<std::string> runs;
    for (const Condition& at : block.conditions) {
      const Key key{at, {method.id, quantity.id}};
      if (const auto found = sums_.find(key); found != sums_.end())
        for (const auto& [run, sum] : found->second) runs.insert(run);
      if (const auto found = lost_.find(key); found != lost_.end())
        runs.insert(found->second.begin(), found->second.end());
    }
    if (runs.empty()) continue;
    if (study_.results.are_repeats) runs = {""};
    for (const std::string& run : runs)
      lines.push_back({.method = method.id,
                       .run = run,
                       .label = run.empty() || groups_.size() < 2
                                    ? method.label
                                    : method.label + ", " + label_of(study_.runs, run),
                       .index = i,
                       .series = series_[i]});
  }
  return lines;
}

RunNumbers ResultsView::numbers(const Condition& at, const ResultsLine& line,
                                const Quantity& quantity) const {
  const Key key{at, {line.method, quantity.id}};
  const auto is_of_line = [&](const std::string& run) {
    return line.run.empty() || run == line.run;
  };
  RunNumbers numbers;
  if (const auto found = sums_.find(key); found != sums_.end())
    for (const auto& [run, sum] : found->second)
      if (is_of_line(run)) numbers.values[run] = sum.first / sum.second;
  // The mean over what is left of a run's subjects would say that losing one makes a method better.
  if (const auto found = lost_.find(key); found != lost_.end())
    for (const std::string& run : found->second) {
      if (!is_of_line(run)) continue;
      numbers.values.erase(run);
      ++numbers.lost;
    }
  return numbers;
}

std::optional<MeanEstimate> ResultsView::mean(const Condition& at, const ResultsLine& line,
                                              const Quantity& quantity) const {
  std::vector<double> values;
  std::vector<int> clusters;
  for (const auto& [run, value] : numbers(at, line, quantity).values) {
    values.push_back(value);
    clusters.push_back(clusters_.at(groups_.at(run)));
  }
  if (values.empty()) return std::nullopt;
  return clustered_mean(values, clusters);
}

std::optional<Interval> ResultsView::interval(const std::optional<MeanEstimate>& mean,
                                              const Quantity& quantity) const {
  if (!mean || !mean->half_width) return std::nullopt;
  constexpr double kMostPercent = 100.0;
  Interval interval{mean->mean - *mean->half_width, mean->mean + *mean->half_width};
  const auto& [least, greatest] = ranges_.at(quantity.id);
  if (least >= 0.0) interval.low = std::max(interval.low, 0.0);
  if (quantity.unit == "%" && least >= 0.0 && greatest <= kMostPercent)
    interval.high = std::min(interval.high, kMostPercent);
  return interval;
}

StatusCounts ResultsView::statuses(const Condition& at, const ResultsLine& line) const {
  StatusCounts counts;
  const auto found = outcomes_.find({at, line.method});
  if (found == outcomes_.end()) return counts;
  for (const RunOutcome* outcome : found->second) {
    if (!line.run.empty() && outcome->run != line.run) continue;
    ++counts.runs;
    for (const std::string& code : std::set(outcome->codes.begin(), outcome->codes.end()))
      ++counts.codes[code];
  }
  return counts;
}

std::map<std::string, double> ResultsView::group_means(
    const std::map<std::string, double>& runs) const {
  std::map<std::string, std::pair<double, int>> sums;
  for (const auto& [run, value] : runs) {
    auto& [sum, count] = sums[groups_.at(run)];
    sum += value;
    ++count;
  }
  std::map<std::string, double> means;
  for (const auto& [group, sum] : sums) means[group] = sum.first / sum.second;
  return means;
}

std::string ResultsView::level_words(const Level& level) const {
  const auto found = std::ranges::find(study_.factors, level.factor, &Label::id);
  const std::string text =
      is_number(level) ? fmt::format("{:.6g}", std::get<double>(level.value)) : level_text(level);
  if (found == study_.factors.end()) return level.factor + " " + text;
  return found->label + " " + with_unit(text, found->unit);
}

std::string ResultsView::factor_label(const std::string& factor) const {
  const auto found = std::ranges::find(study_.factors, factor, &Label::id);
  if (found == study_.factors.end()) return factor;
  return found->unit.empty() ? found->label : fmt::format("{} [{}]", found->label, found->unit);
}

std::string ResultsView::short_words(const Level& level) const {
  return is_number(level) ? level_words(level) : level_text(level);
}

std::string ResultsView::words_of(const ResultsBlock& block, std::size_t condition) const {
  return block.factor.empty() ? block.title
                              : block.title + ", " + level_words(block.levels[condition]);
}

bool is_lost(double value) {
  constexpr double kMost = 1e100;
  return !(std::abs(value) < kMost);
}

std::string ResultsView::setup_slug(const std::string& setup) const {
  const auto slug = [](const std::string& id) { return slug_of(id.empty() ? "all" : id); };
  int same = 1;
  for (const Label& other : study_.setups) {
    if (other.id == setup) break;
    if (slug(other.id) == slug(setup)) ++same;
  }
  return same == 1 ? slug(setup) : fmt::format("{}-{}", slug(setup), same);
}

std::string level_slug(const Level& level) {
  std::string text = level_text(level);
  std::string sign;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.size() > 1 && (is_digit(text[1]) || text[1] == '.')) {
    if (text[0] == '-') sign = "minus-";
    if (text[0] == '+') sign = "plus-";
  }
  if (is_number(level)) {
    // Of an exponent only a minus is a sign that tells numbers apart: "1e-05", "1e05".
    std::erase(text, '+');
    if (const std::size_t minus = text.find("e-"); minus != std::string::npos)
      text.replace(minus, 2, "e-minus-");
  }
  return sign + slug_of(text);
}

int decimals_of(std::vector<double> sizes) {
  constexpr int kSignificant = 3;
  constexpr int kMost = 6;
  std::erase_if(sizes, [](double size) { return !std::isfinite(size) || size == 0.0; });
  for (double& size : sizes) size = std::abs(size);
  if (std::ranges::all_of(sizes, [](double size) { return size == std::floor(size); })) return 0;
  const int before = static_cast<int>(std::floor(std::log10(median(sizes)))) + 1;
  return std::clamp(kSignificant - before, 0, kMost);
}

}  // namespace mapproof
