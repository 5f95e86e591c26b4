#include "reports/sections/results/results_report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/words.hpp"
#include "core/evaluate/evaluation_rows.hpp"
#include "reports/model/format.hpp"
#include "reports/model/page_text.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/provenance.hpp"
#include "reports/sections/results/path_error_figures.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/results/results_data_sets.hpp"
#include "reports/sections/results/results_figures.hpp"
#include "reports/sections/results/results_tables.hpp"
#include "reports/sections/results/results_view.hpp"
#include "reports/sections/results/topic_records.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

std::vector<Paragraph> findings_of(const ResultsReportInput& input) {
  std::vector<Paragraph> findings;
  for (const std::string& conclusion : input.conclusions) findings.push_back(plain(conclusion));
  if (!findings.empty()) return findings;
  for (const MethodComparison& comparison : input.comparisons)
    findings.push_back(plain(sentence_of(comparison, input.view)));
  return findings;
}

/// @param has_opening  The first findings stand above it.
Section summary_section(const ResultsReportInput& input, bool has_opening) {
  const ResultsStudy& study = input.view.study();
  Section section{summary_id(study.name), "Summary", {}};
  if (!study.question.empty() && !has_opening) section.blocks.emplace_back(plain(study.question));
  if (const std::string shared = input.view.shared_words(); !shared.empty() && !has_opening)
    section.blocks.emplace_back(plain("Setups have in common: " + shared + "."));
  if (!input.incomplete.empty())
    section.blocks.emplace_back(
        Callout{Callout::Tone::kWarning, "Incomplete", plain(input.incomplete)});
  const auto rows = std::ssize(study.results.rows);
  const auto lost = std::ranges::count_if(study.results.rows,
                                          [](const Result& row) { return is_lost(row.value); });
  if (lost > 0)
    section.blocks.emplace_back(
        Callout{Callout::Tone::kWarning, "Lost values",
                plain(fmt::format("{} {} no value. Means rest on the others; the notes under the "
                                  "tables count the lost ones.",
                                  part_text(lost, rows, "result"), lost == 1 ? "has" : "have"))});
  for (const std::string& remark : input.remarks)
    section.blocks.emplace_back(Callout{Callout::Tone::kNote, "About the files", plain(remark)});
  for (const std::string& remark : remarks_of(study))
    section.blocks.emplace_back(
        Callout{Callout::Tone::kNote, "About the table", plain("In results.csv " + remark)});
  BulletList findings{findings_of(input)};
  if (findings.items.size() > (has_opening ? kFewComparisons : 0))
    section.blocks.emplace_back(std::move(findings));
  const auto group = std::ranges::find(input.figures.groups, section.id, &FigureGroup::id);
  if (group != input.figures.groups.end()) section.blocks.emplace_back(gallery_of(*group));
  return section;
}

/// What some quantities lack, and why: labels with the same reason in one sentence.
class Reasons {
 public:
  void add(const std::string& label, const std::string& reason) {
    const auto known = std::ranges::find(labels_, reason, &Labels::first);
    if (known == labels_.end())
      labels_.push_back({reason, {label}});
    else
      known->second.push_back(in_sentence(label));
  }
  std::vector<Paragraph> paragraphs() const {
    std::vector<Paragraph> all;
    for (const auto& [reason, labels] : labels_)
      all.push_back(plain(fmt::format("{}{}", fmt::join(labels, "; "), reason)));
    return all;
  }

 private:
  using Labels = std::pair<std::string, std::vector<std::string>>;  ///< By reason.
  std::vector<Labels> labels_;
};

/// Why a block has fewer comparisons than quantities to compare; empty where it has all.
std::vector<Paragraph> uncompared(const ResultsReportInput& input, const ResultsBlock& block) {
  const ResultsStudy& study = input.view.study();
  if (!study.results.are_repeats) return {};
  Reasons reasons;
  for (const Quantity* quantity : input.view.quantities(block)) {
    const bool is_compared = std::ranges::any_of(input.comparisons, [&](const auto& comparison) {
      return comparison.block == &block && comparison.quantity == quantity;
    });
    if (quantity->better != Better::kNeither && !is_compared &&
        input.view.lines(block, *quantity).size() > 1) {
      std::string why = why_not_compared(input.view, block, *quantity);
      if (why.empty())
        why = fmt::format("tests are made by {} alone, which the study judges by first",
                          input.view.quantity(study.quantities.front()).label);
      reasons.add(quantity->label,
                  fmt::format(": the methods are not compared, since {}.", std::move(why)));
    }
  }
  return reasons.paragraphs();
}

/// Why quantities have no figure, those with the same reason in one sentence.
std::vector<Paragraph> why_no_figures(const ResultsView& view, const ResultsBlock& block) {
  Reasons reasons;
  for (const Quantity* quantity : view.quantities(block))
    if (const std::string why = why_no_figure(view, block, *quantity); !why.empty())
      reasons.add(quantity->label, why.substr(quantity->label.size()));
  return reasons.paragraphs();
}

Section block_section(const ResultsReportInput& input, const ResultsBlock& block) {
  Section section{block.id, block.title, {}};
  const auto group = std::ranges::find(input.figures.groups, block.id, &FigureGroup::id);
  if (group != input.figures.groups.end()) section.blocks.emplace_back(gallery_of(*group));
  for (Paragraph& paragraph : why_no_figures(input.view, block))
    section.blocks.emplace_back(std::move(paragraph));
  for (Table& table : results_tables(input.view, block))
    section.blocks.emplace_back(std::move(table));
  for (const MethodComparison& comparison : input.comparisons)
    if (comparison.block == &block)
      section.blocks.emplace_back(comparison_table(input.view, comparison));
  for (Paragraph& paragraph : uncompared(input, block))
    section.blocks.emplace_back(std::move(paragraph));
  return section;
}

/// Whether a block is all of its setup and has a single level, no figure, and one line of a table.
bool is_one_line(const ResultsReportInput& input, const ResultsBlock& block) {
  const std::vector<ResultsBlock>& blocks = input.view.blocks();
  const auto has_setup = [&](const ResultsBlock& other) {
    return other.conditions.front().setup == block.conditions.front().setup;
  };
  const bool is_all_of_setup = (&block == &blocks.front() || !has_setup(*(&block - 1))) &&
                               (&block == &blocks.back() || !has_setup(*(&block + 1)));
  return is_all_of_setup && block.factor.empty() && input.view.study().runs.empty() &&
         only_line(input.view, block) &&
         std::ranges::find(input.figures.groups, block.id, &FigureGroup::id) ==
             input.figures.groups.end();
}

/// Whether two such blocks, of the same method, have the same columns and notes.
bool are_alike(const ResultsReportInput& input, const ResultsBlock& a, const ResultsBlock& b) {
  const ResultsView& view = input.view;
  const RunCounts of_a = view.counts_of(a.conditions.front().setup);
  const RunCounts of_b = view.counts_of(b.conditions.front().setup);
  return view.quantities(a) == view.quantities(b) &&
         why_no_figures(view, a) == why_no_figures(view, b) &&
         only_line(view, a)->index == only_line(view, b)->index && of_a.runs == of_b.runs &&
         of_a.groups == of_b.groups;
}

/// How many blocks from one on share its section, at least one.
std::size_t count_alike(const ResultsReportInput& input, std::span<const ResultsBlock> blocks) {
  std::size_t count = 1;
  while (is_one_line(input, blocks.front()) && count < blocks.size() &&
         is_one_line(input, blocks[count]) && are_alike(input, blocks.front(), blocks[count]))
    ++count;
  return count;
}

/// The id of the section that shows a block.
std::string section_id(const ResultsReportInput& input, const ResultsBlock& block) {
  std::span<const ResultsBlock> rest = input.view.blocks();
  for (std::size_t alike = 0; !rest.empty(); rest = rest.subspan(alike)) {
    alike = count_alike(input, rest);
    if (&block < &rest.front() + alike) return rest.front().id;
  }
  return block.id;
}

/// Blocks that would have a section with one line of a table each.
Section section_of_alike(const ResultsReportInput& input, std::span<const ResultsBlock> blocks) {
  const std::size_t method = only_line(input.view, blocks.front())->index;
  Section section{
      blocks.front().id,
      fmt::format("{} in {} setups", input.view.study().methods[method].label, blocks.size()),
      {}};
  for (Paragraph& paragraph : why_no_figures(input.view, blocks.front()))
    section.blocks.emplace_back(std::move(paragraph));
  section.blocks.emplace_back(blocks_table(input.view, blocks, section.title));
  return section;
}

Section overview_section(const ResultsReportInput& input, const ResultsOverview& overview) {
  Section section{overview.id, overview.title, {}};
  const auto group = std::ranges::find(input.figures.groups, overview.id, &FigureGroup::id);
  if (group != input.figures.groups.end()) section.blocks.emplace_back(gallery_of(*group));
  for (Table& table : overview_tables(input.view, overview))
    section.blocks.emplace_back(std::move(table));
  return section;
}

/// The heat maps of a setup, if it has any.
void add_grid_section(const ResultsReportInput& input, const std::string& setup,
                      std::vector<Section>& sections) {
  const std::string id = heat_maps_id(input.view, setup);
  const auto group = std::ranges::find(input.figures.groups, id, &FigureGroup::id);
  if (group == input.figures.groups.end()) return;
  sections.push_back({id, group->title, {gallery_of(*group)}});
}

/// Puts a setup's sections under its name; its only one stays alone.
void put_under(const std::string& setup, std::span<Section> sections) {
  if (setup.empty() || sections.size() < 2) return;
  for (Section& section : sections) {
    section.title = title_below(setup, section.title);
    section.group = setup;
  }
}

std::vector<Section> sections_of(const ResultsReportInput& input, bool has_opening) {
  std::vector<Section> sections{summary_section(input, has_opening)};
  if (sections[0].blocks.empty()) sections.clear();
  const std::vector<Label>& setups = input.view.study().setups;
  const std::vector<ResultsBlock>& blocks = input.view.blocks();
  for (auto block = blocks.begin(); block != blocks.end();) {
    const std::span<const ResultsBlock> rest(block, blocks.end());
    if (const std::size_t alike = count_alike(input, rest); alike > 1) {
      sections.push_back(section_of_alike(input, rest.first(alike)));
      block += static_cast<std::ptrdiff_t>(alike);
      continue;
    }
    const std::string setup = block->conditions.front().setup;
    const std::size_t first = sections.size();
    add_grid_section(input, setup, sections);
    for (const ResultsOverview& overview : input.view.overviews())
      if (overview.conditions.front().setup == setup)
        sections.push_back(overview_section(input, overview));
    for (; block != blocks.end() && block->conditions.front().setup == setup; ++block)
      sections.push_back(block_section(input, *block));
    // In a report of several studies, sections stand under the name of their study.
    if (has_opening && setups.size() > 1)
      put_under(label_of(setups, setup), std::span(sections).subspan(first));
  }
  const std::string maps = input.view.study().name + "-maps";
  const auto group = std::ranges::find(input.figures.groups, maps, &FigureGroup::id);
  if (group != input.figures.groups.end()) {
    Section section{maps, group->title, {}};
    if (!group->words.empty()) section.blocks.emplace_back(plain(group->words));
    section.blocks.emplace_back(gallery_of(*group));
    sections.push_back(std::move(section));
  }
  for (const FigureGroup& errors : input.figures.groups)
    if (errors.id.starts_with(path_error_prefix(input.view.study())))
      sections.push_back({errors.id, errors.title, {gallery_of(errors)}});
  if (!input.cost.empty()) {
    Section section{input.view.study().name + "-cost", "Cost", {}, "", Interest::kFew};
    for (const Table& table : input.cost) section.blocks.emplace_back(table);
    sections.push_back(std::move(section));
  }
  sections.push_back({input.view.study().name + "-provenance", "Provenance", input.provenance, "",
                      Interest::kFew});
  return sections;
}

}  // namespace

std::vector<Block> given_provenance(const ResultsView& view, const std::string& command) {
  const ResultsStudy& study = view.study();
  std::vector<Block> blocks;
  blocks.emplace_back(plain(
      std::string(
          command.starts_with("mapproof evaluate ") ? "" : "Another program made these results. ") +
      "Every number here is one of results.csv or is computed from its rows; this command "
      "writes the report again:"));
  blocks.emplace_back(KeyValues{{{"Command", {command, Emphasis::kCode}}}});
  KeyValues facts;
  facts.items.push_back({"Results", {"results.csv", Emphasis::kFile}});
  if (!study.command.empty()) facts.items.push_back({"Made by", {study.command, Emphasis::kCode}});
  facts.items.push_back({"Rows", {fmt::format("{}", study.results.rows.size()), Emphasis::kPlain}});
  facts.items.push_back({"Runs", {fmt::format("{}", view.runs()), Emphasis::kPlain}});
  facts.items.push_back({"Groups", {fmt::format("{}", view.groups()), Emphasis::kPlain}});
  blocks.emplace_back(std::move(facts));
  return blocks;
}

namespace {

constexpr std::size_t kMostNumbers = 3;  ///< Comparisons shown by their best value.

/// "ORB (32 poses)": an error of few poses is not that of many.
std::string name_with_poses(const ResultsReportInput& input, std::size_t method) {
  const Label& label = input.view.study().methods[method];
  const auto poses = input.poses.find(label.id);
  return poses == input.poses.end()
             ? label.label
             : fmt::format("{} ({})", label.label, counted(poses->second, "pose"));
}

constexpr std::size_t kMostLeftOut = 2;  ///< Methods that a tile names as not compared.

/// The best method's mean in the first comparisons, each of another quantity or setup.
void add_best_values(const ResultsReportInput& input, Highlights& numbers) {
  std::vector<std::string> shown;
  for (const MethodComparison& comparison : input.comparisons) {
    if (!is_crowned(*comparison.quantity)) continue;
    const std::string label = comparison.quantity->label;
    const bool great_errors = input.view.has_great_errors(*comparison.quantity);
    // "ATE, RMSE", "ATE, mean" and "ATE, median" are one thing.
    const std::string stem = label.substr(0, label.find(','));
    if (numbers.items.size() == kMostNumbers || std::ranges::find(shown, stem) != shown.end())
      continue;
    shown.push_back(stem);
    const ComparedMethod& best = comparison.methods.front();
    const auto worse = std::ranges::count_if(comparison.methods, is_significant);
    const auto others = std::ssize(comparison.methods) - 1;
    const std::string left_out =
        comparison.left_out.empty() ? "" : listed(comparison.left_out, kMostLeftOut);
    const ComparedMethod& next = comparison.methods[1];
    const bool is_one = input.view.runs() < 2;
    std::string note = name_with_poses(input, best.method) + "; ";
    if (!has_groups_for_tests(comparison))
      note += fmt::format("{} {}", name_with_poses(input, next.method),
                          lone_value(next.mean, *comparison.quantity, great_errors));
    else if (worse == 0)
      note += left_out.empty()
                  ? "not significantly better than any other method (paired test)"
                  : fmt::format("not significantly better than any compared (not compared: {})",
                                left_out);
    else
      note +=
          fmt::format("significantly better than {} {} ({})",
                      others == 1 ? "the other" : fmt::format("{} of {}", worse, others),
                      left_out.empty() ? (others == 1 ? "method" : "other methods") : "compared",
                      left_out.empty() ? "paired test" : "not compared: " + left_out);
    // Means of tables are over all runs of each method.
    if (!comparison.has_all_runs) note += "; over the " + counted(comparison.runs, "common run");
    numbers.items.push_back(
        {fmt::format("{} {}, {}", is_one ? "best" : "best mean of", in_sentence(label),
                     in_sentence(comparison.block->title) +
                         where_of(comparison).substr(comparison.block->title.size())),
         lone_value(best.mean, *comparison.quantity, great_errors), std::move(note),
         comparison.block->id});
  }
}

/// The method that is the best over data sets that are no repeats of each other.
struct BestOverRuns {
  const Quantity* quantity = nullptr;
  std::size_t method = 0;
  double median = kNaN;
  std::string run = {};  ///< Where it is best.
};

/// The values of each method, by run, in the study's first block.
std::map<std::size_t, ValuesByRun> values_over_runs(const ResultsView& view,
                                                    const Quantity& quantity) {
  std::map<std::size_t, ValuesByRun> values;
  const ResultsBlock& block = view.blocks().front();
  for (const ResultsLine& line : view.lines(block, quantity))
    for (const Condition& at : block.conditions)
      values[line.index].merge(view.numbers(at, line, quantity).values);
  return values;
}

/// By the median of its values; only methods with a value in as many runs as any.
/// @return Empty where runs are repeats, or no quantity has a better way.
std::optional<BestOverRuns> best_over_runs(const ResultsView& view) {
  const ResultsStudy& study = view.study();
  if (study.runs.empty() || view.blocks().empty()) return std::nullopt;
  const auto id = std::ranges::find_if(study.quantities, [&](const std::string& one) {
    return view.quantity(one).better != Better::kNeither;
  });
  if (id == study.quantities.end()) return std::nullopt;
  BestOverRuns best{.quantity = &view.quantity(*id)};
  const double sign = best.quantity->better == Better::kLower ? 1.0 : -1.0;
  std::size_t most = 1;
  for (const auto& [method, values] : values_over_runs(view, *best.quantity)) {
    if (values.size() < most) continue;
    std::vector<double> numbers;
    for (const auto& [run, value] : values) numbers.push_back(value);
    const double middle = median(numbers);
    if (values.size() == most && !(std::isnan(best.median) || sign * middle < sign * best.median))
      continue;
    most = values.size();
    best.method = method;
    best.median = middle;
    best.run = std::ranges::min_element(values, {}, [sign](const auto& one) {
                 return sign * one.second;
               })->first;
  }
  return std::isnan(best.median) ? std::nullopt : std::optional(best);
}

/// Its median as the first number.
void add_best_over_runs(const ResultsReportInput& input, Highlights& numbers) {
  const auto best = best_over_runs(input.view);
  if (!best) return;
  const ResultsStudy& study = input.view.study();
  numbers.items.push_back(
      {fmt::format("median {} of the best method", best->quantity->label),
       lone_value(best->median, *best->quantity, input.view.has_great_errors(*best->quantity)),
       fmt::format("{}, over {}", study.methods[best->method].label,
                   counted(std::ssize(study.runs), "data set")),
       input.view.blocks().front().id});
}

/// "only 75.1 % of the poses are associated (orb, desk)"; empty if there are enough of each path.
std::string few_associated(const ResultsStudy& study) {
  std::vector<std::string> few;
  for (const Result& row : study.results.rows)
    if (row.quantity == kAssociatedPercent && row.value < kFewAssociated_percent)
      few.push_back(fmt::format("{} ({}, {})", quantity_text(row.value, "%"),
                                label_of(study.methods, row.method), row.run.get()));
  constexpr std::size_t kMostNamed = 3;
  return few.empty() ? ""
                     : fmt::format("only {} of the poses are associated", listed(few, kMostNamed));
}

/// Where nothing is compared: the first method's means of the quantities that a study judges by,
/// where they are judged first.
void add_means(const ResultsReportInput& input, Highlights& numbers) {
  const ResultsView& view = input.view;
  const ResultsStudy& study = view.study();
  std::vector<std::string> shown;
  for (const ResultsBlock& block : view.blocks())
    for (const Quantity* quantity : view.quantities(block)) {
      const std::vector<ResultsLine> lines = view.lines(block, *quantity);
      const std::string stem = quantity->label.substr(0, quantity->label.find(','));
      if (numbers.items.size() == kMostNumbers || quantity->better == Better::kNeither ||
          lines.empty() || std::ranges::find(shown, stem) != shown.end())
        continue;
      const std::size_t last = block.conditions.size() - 1;
      const auto mean = view.mean(block.conditions[last], lines.front(), *quantity);
      if (!mean) continue;
      shown.push_back(stem);
      numbers.items.push_back(
          {quantity->label + (block.factor.empty() ? "" : ", " + view.words_of(block, last)),
           lone_value(mean->mean, *quantity, view.has_great_errors(*quantity)),
           study.methods[lines.front().index].label, section_id(input, block),
           quantity->id == kAssociatedPercent && !few_associated(study).empty()});
    }
}

/// "ORB has 32 poses, DSO 785", of the methods with fewest and with most; empty if none has less
/// than half as many as another.
std::string unequal_poses(const ResultsReportInput& input) {
  if (input.poses.size() < 2) return "";
  const auto [fewest, most] = std::ranges::minmax_element(
      input.poses, {}, &std::pair<const std::string, long long>::second);
  if (2 * fewest->second >= most->second) return "";
  const std::vector<Label>& methods = input.view.study().methods;
  return fmt::format("errors are of different poses: {} has {}, {} {}",
                     label_of(methods, fewest->first), counted(fewest->second, "pose"),
                     label_of(methods, most->first), count_text(most->second));
}

/// Where the mean of a quantity is that of maps or paths that diverged.
struct Divergence {
  const Quantity* quantity = nullptr;
  std::vector<std::string> where = {};  ///< One at least.
};

/// "the mean ATE of DSO is over 1 km (outdoors; and 1 more)": of each method whose maps or paths
/// diverged in the mean, the first quantity and where; empty if none did.
std::string diverged_methods(const ResultsView& view) {
  constexpr std::size_t kMostDiverged = 3;
  std::map<std::size_t, Divergence> found;  // By the method's index.
  for (const ResultsBlock& block : view.blocks())
    for (const Quantity* quantity : view.quantities(block)) {
      if (!view.has_great_errors(*quantity)) continue;
      for (const ResultsLine& line : view.lines(block, *quantity))
        for (std::size_t i = 0; i < block.conditions.size(); ++i) {
          const auto mean = view.mean(block.conditions[i], line, *quantity);
          if (!mean || mean->mean <= kGreatestError_m) continue;
          Divergence& divergence = found.try_emplace(line.index, quantity).first->second;
          if (divergence.quantity->id == quantity->id)
            divergence.where.push_back(view.words_of(block, i));
        }
    }
  std::vector<std::string> texts;
  for (const auto& [method, divergence] : found) {
    const std::size_t more = divergence.where.size() - 1;
    texts.push_back(fmt::format("the mean {} of {} is {} ({}{})", divergence.quantity->label,
                                view.study().methods[method].label, error_text(kInfinity),
                                divergence.where.front(),
                                more == 0 ? "" : fmt::format("; and {} more", more)));
  }
  return listed(texts, kMostDiverged);
}

/// "20 of 92 outcomes of methods have warnings: uncertified (12) and not Euclidean (7)", the most
/// frequent first; empty if all ended well.
std::string warnings_of_runs(const ResultsStudy& study) {
  std::map<std::string, long long> runs;  // By code.
  long long with_warnings = 0;
  for (const RunOutcome& outcome : study.results.outcomes) {
    with_warnings += outcome.codes.empty() ? 0 : 1;
    for (const std::string& code : std::set(outcome.codes.begin(), outcome.codes.end()))
      ++runs[code];
  }
  if (with_warnings == 0) return "";
  std::vector<std::pair<std::string, long long>> order(runs.begin(), runs.end());
  std::ranges::stable_sort(order, std::greater(), &std::pair<std::string, long long>::second);
  std::vector<std::string> names;
  for (const auto& [code, count] : order)
    names.push_back(fmt::format("{} ({})", code_words(code), count_text(count)));
  constexpr std::size_t kMostNamed = 4;
  return fmt::format("{} of {} outcomes of methods {} warnings: {}", count_text(with_warnings),
                     count_text(std::ssize(study.results.outcomes)),
                     with_warnings == 1 ? "has" : "have", listed(names, kMostNamed));
}

/// What is missing or lost, and what whoever knows the study says.
std::vector<std::string> warnings_of(const ResultsReportInput& input) {
  std::vector<std::string> warnings = input.warnings;
  const auto add = [&](const std::string& text) {
    if (!text.empty()) warnings.push_back(text);
  };
  if (!input.incomplete.empty()) add("incomplete: " + input.incomplete);
  add(diverged_methods(input.view));
  add(losses_of(input.view));
  add(warnings_of_runs(input.view.study()));
  add(few_associated(input.view.study()));
  add(unequal_poses(input));
  return warnings;
}

/// The section with the figure that shows the headline; the first block's if there is none.
std::string headline_section(const ResultsReportInput& input) {
  const std::vector<std::string> ids = present_ids(input.headline_figures, input.figures, 1);
  for (const FigureGroup& group : input.figures.groups)
    if (!ids.empty() &&
        std::ranges::find(group.figures, ids.front(), &Figure::id) != group.figures.end())
      return group.id;
  return input.view.blocks().front().id;
}

Highlights numbers_of(const ResultsReportInput& input, const std::vector<std::string>& warnings) {
  const ResultsStudy& study = input.view.study();
  Highlights numbers;
  if (!input.headline.value.empty()) {
    numbers.items.push_back(input.headline);
    if (!input.view.blocks().empty()) numbers.items.back().section = headline_section(input);
  } else {
    add_best_values(input, numbers);
    if (numbers.items.empty()) add_best_over_runs(input, numbers);
    if (numbers.items.empty()) add_means(input, numbers);
  }
  if (numbers.items.empty())
    numbers.items.push_back({study.methods.size() == 1 ? "method" : "methods",
                             fmt::format("{}", study.methods.size()),
                             counted(static_cast<long long>(input.view.runs()),
                                     study.runs.empty() ? "run" : "data set")});
  const std::string provenance = study.name + "-provenance";
  if (!warnings.empty())
    numbers.items.push_back(
        {warnings.size() == 1 ? "warning" : "warnings", fmt::format("{}", warnings.size()),
         warnings.front(),
         input.view.blocks().empty() ? provenance : input.view.blocks().front().id, true});
  else if (const auto rows = std::ssize(study.results.rows); rows > 0)
    numbers.items.push_back({fmt::format("of {} have no value", counted(rows, "result")), "0",
                             "nothing was lost", provenance});
  return numbers;
}

/// What is wrong, in one paragraph.
Paragraph warnings_paragraph(const std::vector<std::string>& warnings) {
  std::string text = warnings.empty() ? "none; every result has a value." : "";
  for (const std::string& one : warnings) text += (text.empty() ? "" : "; ") + one;
  if (!text.ends_with('.')) text += '.';
  return plain(": " + text);
}

/// What the results are judged against: as stated, else each other.
Paragraph compared_with(const ResultsReportInput& input) {
  const ResultsStudy& study = input.view.study();
  if (!input.compared_with.empty()) return plain(": " + input.compared_with + ".");
  const auto methods = static_cast<long long>(study.methods.size());
  if (methods < 2) return plain(": nothing; the study has one method and no ground truth.");
  return plain(fmt::format(
      ": each other, {} over {}.", counted(methods, "method"),
      counted(static_cast<long long>(input.view.runs()), study.runs.empty() ? "run" : "data set")));
}

/// Those that stand for a group in the opening: the first one, and others spread over the rest, so
/// that neighbours, which are of one data set, do not fill it. Maps that are of no use are left
/// out.
std::vector<std::string> spread(const std::vector<Figure>& figures) {
  std::vector<std::string> usable, ids;
  for (const Figure& figure : figures)
    if (figure.title.find(kNoUsableMap) == std::string::npos) usable.push_back(figure.id);
  constexpr std::size_t kMost = 6;
  const std::size_t step = std::max<std::size_t>(1, usable.size() / kMost);
  for (std::size_t i = 0; i < usable.size(); i += step) ids.push_back(usable[i]);
  return ids;
}

/// First what the study is judged by: the errors of all systems together, or the values on all data
/// sets, or the first figure. Then what a reader wants to open: the best method's map where it is
/// best, the best map in space, other maps and paths, and curves; groups take turns.
std::vector<std::string> figure_ids_of(const ResultsView& view, const StudyFigures& figures) {
  const ResultsStudy& study = view.study();
  std::vector<std::string> ids;
  if (const auto best = best_over_runs(view)) {
    ids.push_back(data_sets_figure_id(view.blocks().front(), *best->quantity));
    ids.push_back(id_below(
        study.name,
        fmt::format("map-{}-{}", slug_of(study.methods[best->method].id), slug_of(best->run))));
  }
  std::vector<std::vector<std::string>> groups;
  std::vector<std::string> scenes;
  std::ptrdiff_t paths = 0;  // The first of them.
  std::vector<std::string> maps;
  for (const FigureGroup& group : figures.groups) {
    for (const Scene& scene : group.scenes) scenes.push_back(scene.id);
    std::vector<std::string> own = spread(group.figures);
    const bool is_of_paths = group.id.starts_with(path_error_prefix(study));
    if (is_of_paths && study.methods.size() > 1) own.insert(own.begin(), group.id + "-curves");
    if (group.id == study.name + "-maps") {
      maps = std::move(own);
      continue;
    }
    groups.insert(is_of_paths ? groups.begin() + paths++ : groups.end(), std::move(own));
  }
  if (!groups.empty() && !groups.front().empty()) ids.push_back(groups.front().front());
  if (!maps.empty() && paths == 0) ids.push_back(maps.front());
  ids.insert(ids.end(), scenes.begin(), scenes.end());
  groups.insert(groups.begin() + paths, std::move(maps));
  std::ranges::move(in_turns(groups), std::back_inserter(ids));
  return ids;
}

Opening opening_of(const ResultsReportInput& input) {
  Opening opening;
  opening.question = input.view.study().question;
  if (input.conclusions.empty())
    for (std::string& headline : headlines_of(input.view, input.comparisons))
      opening.findings.push_back(plain(std::move(headline)));
  else
    for (const std::string& conclusion : input.conclusions)
      if (opening.findings.size() < kFewComparisons) opening.findings.push_back(plain(conclusion));
  opening.warnings = warnings_of(input);
  opening.numbers = numbers_of(input, opening.warnings);
  opening.wrong = warnings_paragraph(opening.warnings);
  opening.compared_with = compared_with(input);
  choose_figures(figure_ids_of(input.view, input.figures), input.figures, opening,
                 input.headline_figures);
  return opening;
}

}  // namespace

std::vector<Section> results_sections(const ResultsReportInput& input) {
  return sections_of(input, false);
}

Report results_report(const ResultsReportInput& input) {
  const ResultsStudy& study = input.view.study();
  Report report;
  report.title = study.title;
  report.subtitle = fmt::format(
      "{}, {}", counted(static_cast<long long>(study.methods.size()), "method"),
      counted(static_cast<long long>(input.view.runs()), study.runs.empty() ? "run" : "data set"));
  if (const std::string shared = input.view.shared_words(); !shared.empty())
    report.subtitle += "; " + shared;
  report.sections = sections_of(input, true);
  report.opening = opening_of(input);
  report.footer = input.footer;
  report.date = input.date;
  return report;
}

}  // namespace mapproof
