#include "reports/sections/results/results_view.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/words.hpp"

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

ResultsView::ResultsView(const ResultsStudy& study) : study_(study) {
  for (const Result& row : study.results.rows) {
    const Key key{row.at, {row.method, row.quantity}};
    groups_[row.run] = row.group;
    clusters_.try_emplace(row.group, static_cast<int>(clusters_.size()));
    if (is_lost(row.value)) {
      lost_[key].insert(row.run);
      continue;
    }
    auto& [sum, count] = sums_[key][row.run];
    sum += row.value;
    ++count;
  }
  for (const std::string& id : study.quantities) {
    Quantity quantity = study.results.quantities.at(id);
    const auto label = std::ranges::find(study.quantity_labels, id, &Label::id);
    if (label != study.quantity_labels.end()) quantity.label = label->label;
    quantities_.emplace(id, std::move(quantity));
  }
  for (const RunOutcome& outcome : study.results.outcomes)
    outcomes_[{outcome.at, outcome.method}].push_back(&outcome);
  make_blocks();
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
    for (const Level& other : others.levels) {
      block.title += ", " + level_words(other);
      block.id += "-" + slug_of(other.factor + "-" + level_text(other));
    }
    if (block.id.back() == '-') block.id += "setup";
  }
  for (auto& [others, block] : blocks) blocks_.push_back(std::move(block));
}

std::vector<const Quantity*> ResultsView::quantities(const ResultsBlock& block) const {
  std::vector<const Quantity*> found;
  for (const std::string& id : study_.quantities) {
    const Quantity& quantity = this->quantity(id);
    if (!lines(block, quantity).empty()) found.push_back(&quantity);
  }
  return found;
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
                       .index = i});
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
  if (const auto found = lost_.find(key); found != lost_.end())
    for (const std::string& run : found->second)
      if (is_of_line(run) && !numbers.values.contains(run)) ++numbers.lost;
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
  const bool is_close = found->unit.empty() || found->unit == "\u00B0";
  return found->label + " " + text + (is_close ? "" : " ") + found->unit;
}

std::string ResultsView::factor_label(const std::string& factor) const {
  const auto found = std::ranges::find(study_.factors, factor, &Label::id);
  if (found == study_.factors.end()) return factor;
  return found->unit.empty() ? found->label : fmt::format("{} [{}]", found->label, found->unit);
}

bool is_lost(double value) {
  constexpr double kMost = 1e100;
  return !(std::abs(value) < kMost);
}

std::string slug_of(const std::string& text) {
  std::string slug;
  for (const char c : lower_case(text)) {
    const bool is_kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (is_kept)
      slug += c;
    else if (!slug.empty() && slug.back() != '-')
      slug += '-';
  }
  while (!slug.empty() && slug.back() == '-') slug.pop_back();
  return slug;
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
