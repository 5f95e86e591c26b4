#include "reports/sections/results/results_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/text/ascii.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/method_series.hpp"
#include "reports/sections/tables/cells.hpp"

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
  for (const std::string& id : study.quantities) {
    Quantity quantity = study.results.quantities.at(id);
    const auto label = std::ranges::find(study.quantity_labels, id, &Label::id);
    if (label != study.quantity_labels.end()) quantity.label = label->label;
    if (quantity.unit == "s") {
      std::vector<double> seconds;
      for (const Result& row : study.results.rows)
        if (row.quantity == id) seconds.push_back(row.value);
      std::tie(scales_[id], quantity.unit) = scale_of_seconds(std::move(seconds));
    }
    quantities_.emplace(id, std::move(quantity));
  }
  series_ = styles_of(study);
  take_rows();
  name_setups();
  find_shared_levels();
  for (const RunOutcome& outcome : study.results.outcomes)
    outcomes_[{outcome.at, outcome.method}].push_back(&outcome);
  make_blocks();
  make_overviews();
  set_decimals();
}

namespace {

/// Names, each counted once per setup; the rows of a setup stand together.
class CountOfSetup {
 public:
  void add(const Name& name, const Name& setup, std::size_t& count) {
    if (name.id() >= last_.size()) last_.resize(name.id() + std::size_t{1}, kNone);
    count += std::exchange(last_[name.id()], setup.id()) != setup.id();
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> last_;  ///< By Name::id(): the setup that has it last.
};

}  // namespace

void ResultsView::take_rows() {
  CountOfSetup runs, groups;
  const Rows rows = study_.results.rows;
  const auto key_of = [](const Result& row) { return Key{row.at, row.method, row.quantity}; };
  for (auto first = rows.begin(); first != rows.end();) {
    const Key key = key_of(*first);
    const auto end =
        std::find_if(first, rows.end(), [&](const Result& row) { return key_of(row) != key; });
    if (!rows_.emplace(key, Rows(first, end)).second)
      throw InvalidInput("the rows of a study are not in order");
    const auto scale = scales_.find(key.quantity);
    RunCounts& counts = counts_[key.at.setup];
    for (; first != end; ++first) {
      runs.add(first->run, key.at.setup, counts.runs);
      groups.add(first->group, key.at.setup, counts.groups);
      groups_.set(first->run, first->group);
      const std::uint32_t group = first->group.id();
      if (group >= clusters_.size()) clusters_.resize(group + std::size_t{1}, -1);
      if (clusters_[group] < 0) clusters_[group] = static_cast<int>(groups_in_all_++);
      if (first->value <= kGreatestError_m) usual_errors_.insert(key.quantity);
      if (is_lost(first->value)) continue;
      const double value = scale == scales_.end() ? first->value : scale->second * first->value;
      auto& [least, greatest] = ranges_.try_emplace(key.quantity, value, value).first->second;
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
  }
}

RunCounts ResultsView::counts_of(const std::string& setup) const {
  const auto found = counts_.find(Name(setup));
  return found == counts_.end() ? RunCounts() : found->second;
}

ResultsView::Rows ResultsView::rows_of(const Condition& at, const Name& method,
                                       const Name& quantity) const {
  const auto found = rows_.find({at, method, quantity});
  return found == rows_.end() ? Rows() : found->second;
}

void ResultsView::name_setups() {
  std::map<std::string, int> same;
  for (const Label& setup : study_.setups) {
    const std::string slug = slug_of(setup.id.empty() ? "all" : setup.id);
    const int number = ++same[slug];
    slugs_.emplace(setup.id, number == 1 ? slug : fmt::format("{}-{}", slug, number));
  }
}

void ResultsView::find_shared_levels() {
  std::map<std::string, std::set<Level>> levels;
  std::map<std::string, std::set<Name>> setups;
  for (const auto& [key, rows] : rows_)
    for (const Level& level : key.at.levels) {
      levels[level.factor].insert(level);
      setups[level.factor].insert(key.at.setup);
    }
  for (const auto& [factor, of_factor] : levels)
    if (of_factor.size() == 1 && setups[factor].size() > 1)
      shared_levels_.push_back(*of_factor.begin());
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
  const Key first{.at = {.setup = setup.id}, .method = {}, .quantity = {}};
  for (auto key = rows_.lower_bound(first);
       key != rows_.end() && key->first.at.setup == first.at.setup; ++key)
    conditions.insert(conditions.end(), key->first.at);
  const std::string axis = axis_of(conditions);
  std::set<std::string> factors;
  for (const Condition& at : conditions)
    for (const Level& level : at.levels) factors.insert(level.factor);
  // By the other levels; with the axis?
  std::map<std::pair<std::vector<Level>, bool>, ResultsBlock> blocks;
  for (const Condition& at : conditions) {
    std::vector<Level> others = at.levels;
    const auto on_axis = std::ranges::find(others, axis, &Level::factor);
    const bool has_axis = on_axis != others.end();
    std::optional<Level> level;
    if (has_axis) {
      level = *on_axis;
      others.erase(on_axis);
    }
    ResultsBlock& block = blocks[{others, has_axis}];
    if (level) block.levels.push_back(*level);
    block.conditions.push_back(at);
    if (block.conditions.size() > 1) continue;
    block.factor = has_axis ? axis : "";
    block.title = setup.label.empty() ? study_.title : setup.label;
    block.id = study_.name + "-" + slug_of(setup.id.empty() ? "all" : setup.id);
    block.others = others;
    for (const Level& other : others) {
      if (std::ranges::find(shared_levels_, other) == shared_levels_.end())
        block.title += ", " + level_words(other);
      block.id += "-" + slug_of(other.factor) + "-" + level_slug(other);
    }
    for (const std::string& factor : factors)
      if (std::ranges::find(at.levels, factor, &Level::factor) == at.levels.end()) {
        block.title += ", without " + label_of(study_.factors, factor);
        block.id += "-without-" + slug_of(factor);
      }
    if (block.id.back() == '-') block.id += "setup";
    block.id = bounded_id(std::move(block.id), kLongestBlockId);
  }
  for (auto& [others, block] : blocks) blocks_.push_back(std::move(block));
}

void ResultsView::make_overviews() {
  // Blocks of one setup, of one factor, that give levels of the same other factors.
  using Likeness = std::tuple<std::string, std::string, std::vector<std::string>>;
  std::vector<std::vector<const ResultsBlock*>> alike;
  std::map<Likeness, std::size_t> indices;
  for (const ResultsBlock& block : blocks_) {
    std::vector<std::string> others;
    for (const Level& level : block.others) others.push_back(level.factor);
    const Likeness likeness{block.conditions.front().setup, block.factor, others};
    const auto [index, is_new] = indices.emplace(likeness, alike.size());
    if (is_new) alike.emplace_back();
    alike[index->second].push_back(&block);
  }
  for (const std::vector<const ResultsBlock*>& blocks : alike)
    if (blocks.size() > 1)
      if (auto overview = overview_of(blocks)) overviews_.push_back(*std::move(overview));
  std::map<std::string, std::string> labels;
  for (const Label& setup : study_.setups) labels.emplace(setup.id, setup.label);
  std::set<std::string> ids;
  for (ResultsOverview& overview : overviews_) {
    const std::string& setup = overview.blocks.front()->conditions.front().setup;
    const std::string& label = labels.at(setup);
    overview.title = (label.empty() ? study_.title : label) + ": overview by " + overview.factors;
    overview.id = bounded_id(study_.name + "-overview-" + slug_of(setup.empty() ? "all" : setup),
                             kLongestBlockId);
    while (!ids.insert(overview.id).second) overview.id += "-more";
  }
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

namespace {

/// Those that give the median three significant digits and the least at least one, but two where
/// the least is the best: with one, nobody sees how far the best methods are apart.
int decimals_of_means(std::vector<double> means, Better better) {
  constexpr int kMost = 6;
  std::erase_if(means, [](double mean) { return is_lost(mean) || mean == 0.0; });
  for (double& mean : means) mean = std::abs(mean);
  if (std::ranges::all_of(means, [](double mean) { return mean == std::floor(mean); })) return 0;
  const auto decimals = [](double size, int digits) {
    return digits - 1 - static_cast<int>(std::floor(std::log10(size)));
  };
  const int digits_of_least = better == Better::kLower ? 2 : 1;
  return std::clamp(
      std::max(decimals(median(means), 3), decimals(std::ranges::min(means), digits_of_least)), 0,
      kMost);
}

}  // namespace

void ResultsView::set_decimals() {
  for (const auto& [id, quantity] : quantities_) {
    std::vector<double> means;
    for (const ResultsBlock& block : blocks_)
      for (const ResultsLine& line : lines(block, quantity))
        for (const Condition& at : block.conditions)
          if (const auto mean = this->mean(at, line, quantity)) means.push_back(mean->mean);
    // Pages show no digits of those that diverged.
    if (has_great_errors(quantity))
      std::erase_if(means, [](double mean) { return mean > kGreatestError_m; });
    const int decimals = decimals_of_means(std::move(means), quantity.better);
    decimals_[id] = id.starts_with("moe_") ? std::min(decimals, kMoeDecimals) : decimals;
  }
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
         usual_errors_.contains(quantity.id);
}

std::vector<ResultsLine> ResultsView::lines(const ResultsBlock& block,
                                            const Quantity& quantity) const {
  std::vector<ResultsLine> lines;
  const Name of = quantity.id;
  for (std::size_t i = 0; i < study_.methods.size(); ++i) {
    const Label& method = study_.methods[i];
    const Name id = method.id;
    std::set<Name> runs;
    for (const Condition& at : block.conditions) {
      const Rows rows = rows_of(at, id, of);
      if (study_.results.are_repeats && !rows.empty()) runs = {Name()};
      if (!study_.results.are_repeats)
        for (const Result& row : rows) runs.insert(row.run);
    }
    for (const Name& run : runs)
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
  const auto scale = scales_.find(quantity.id);
  const double factor = scale == scales_.end() ? 1.0 : scale->second;
  const Rows rows = rows_of(at, line.method, quantity.id);
  const Name of_line = line.run;
  RunNumbers numbers;
  if (of_line.empty()) numbers.values.reserve(rows.size());
  for (auto first = rows.begin(); first != rows.end();) {
    const Name run = first->run;
    double sum = 0.0;
    int count = 0;
    bool is_any_lost = false;
    for (; first != rows.end() && first->run == run; ++first, ++count) {
      sum += factor * first->value;
      is_any_lost = is_any_lost || is_lost(first->value);
    }
    if (!of_line.empty() && run != of_line) continue;
    // The mean over what is left of a run's subjects would say that losing one makes a method
    // better.
    if (is_any_lost)
      ++numbers.lost;
    else
      numbers.values[run] = sum / count;
  }
  return numbers;
}

std::optional<MeanEstimate> ResultsView::mean(const Condition& at, const ResultsLine& line,
                                              const Quantity& quantity) const {
  std::vector<double> values;
  std::vector<int> clusters;
  {
    const ValuesByRun by_run = numbers(at, line, quantity).values;
    values.reserve(by_run.size());
    clusters.reserve(by_run.size());
    for (const auto& [run, value] : by_run) {
      values.push_back(value);
      clusters.push_back(clusters_[groups_.find(run)->id()]);
    }
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

std::optional<Interval> ResultsView::spread(const Condition& at, const ResultsLine& line,
                                            const Quantity& quantity) const {
  if (has_groups_for_intervals()) return interval(mean(at, line, quantity), quantity);
  std::vector<double> values;
  for (const auto& [run, value] : numbers(at, line, quantity).values) values.push_back(value);
  if (values.size() < 2) return std::nullopt;
  const auto [least, greatest] = std::ranges::minmax(values);
  return Interval{least, greatest};
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

std::string ResultsView::shared_words() const {
  std::vector<std::string> words;
  for (const Level& level : shared_levels_) words.push_back(level_words(level));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string ResultsView::level_words(const Level& level) const {
  const auto found = std::ranges::find(study_.factors, level.factor, &Label::id);
  const std::string text =
      is_number(level) ? level_number_text(std::get<double>(level.value)) : level_text(level);
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

std::vector<std::size_t> styles_of(const ResultsStudy& study) {
  std::map<std::string, std::set<std::string>> setups_by_method;
  const Result* last = nullptr;  // Millions of rows may have the same names one after the other.
  for (const Result& row : study.results.rows) {
    if (last == nullptr || last->method != row.method || last->at.setup != row.at.setup)
      setups_by_method[row.method].insert(row.at.setup);
    last = &row;
  }
  std::vector<std::string> ids, labels;
  std::vector<std::set<std::string>> setups;
  for (const Label& method : study.methods) {
    ids.push_back(method.id);
    labels.push_back(method.label);
    setups.push_back(setups_by_method[method.id]);
  }
  ids.emplace_back();
  labels.emplace_back();
  setups.emplace_back();
  return series_of_methods(ids, labels, setups);
}

bool is_lost(double value) {
  constexpr double kMost = 1e100;
  return !(std::abs(value) < kMost);
}

std::string level_slug(const Level& level) {
  std::string text = level_text(level);
  std::string sign;
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

}  // namespace mapproof
