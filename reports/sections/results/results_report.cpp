#include "reports/sections/results/results_report.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "reports/sections/results/results_tables.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostThumbnails = 6;

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
  Section section{study.name + "-summary", "Summary", {}};
  if (!study.question.empty()) section.blocks.emplace_back(plain(study.question));
  if (!input.incomplete.empty())
    section.blocks.emplace_back(
        Callout{Callout::Tone::kWarning, "Incomplete", plain(input.incomplete)});
  const auto rows = std::ssize(study.results.rows);
  const auto lost = std::ranges::count_if(study.results.rows,
                                          [](const Result& row) { return is_lost(row.value); });
  if (lost > 0)
    section.blocks.emplace_back(
        Callout{Callout::Tone::kWarning, "Lost values",
                plain(fmt::format("{} of {} have no value. Means rest on the others; the notes "
                                  "under the tables count the lost ones.",
                                  lost, counted(rows, "result")))});
  for (const std::string& remark : input.remarks)
    section.blocks.emplace_back(Callout{Callout::Tone::kNote, "About the files", plain(remark)});
  for (const std::string& remark : remarks_of(study))
    section.blocks.emplace_back(
        Callout{Callout::Tone::kNote, "About the table", plain("In results.csv " + remark)});
  BulletList findings{findings_of(input)};
  if (findings.items.size() > (has_opening ? kFewComparisons : 0))
    section.blocks.emplace_back(std::move(findings));
  return section;
}

/// Why a block has fewer comparisons than quantities to compare; empty where it has all.
std::vector<Paragraph> uncompared(const ResultsReportInput& input, const ResultsBlock& block) {
  std::vector<Paragraph> all;
  if (!input.view.study().results.are_repeats) return all;
  for (const Quantity* quantity : input.view.quantities(block)) {
    const bool is_compared = std::ranges::any_of(input.comparisons, [&](const auto& comparison) {
      return comparison.block == &block && comparison.quantity == quantity;
    });
    if (quantity->better != Better::kNeither && !is_compared &&
        input.view.lines(block, *quantity).size() > 1)
      all.push_back(plain(fmt::format(
          "{}: the methods are not compared, since no two have values in the same runs.",
          quantity->label)));
  }
  return all;
}

Section block_section(const ResultsReportInput& input, const ResultsBlock& block) {
  Section section{block.id, block.title, {}};
  const auto group = std::ranges::find(input.figures.groups, block.id, &FigureGroup::id);
  if (group != input.figures.groups.end()) section.blocks.emplace_back(gallery_of(*group));
  for (const Quantity* quantity : input.view.quantities(block))
    if (std::string why = why_no_figure(input.view, block, *quantity); !why.empty())
      section.blocks.emplace_back(plain(std::move(why)));
  for (Table& table : results_tables(input.view, block))
    section.blocks.emplace_back(std::move(table));
  for (const MethodComparison& comparison : input.comparisons)
    if (comparison.block == &block)
      section.blocks.emplace_back(comparison_table(input.view, comparison));
  for (Paragraph& paragraph : uncompared(input, block))
    section.blocks.emplace_back(std::move(paragraph));
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
  const std::string id =
      fmt::format("{}-{}-grid", input.view.study().name, input.view.setup_slug(setup));
  const auto group = std::ranges::find(input.figures.groups, id, &FigureGroup::id);
  if (group == input.figures.groups.end()) return;
  sections.push_back({id, group->title, {gallery_of(*group)}});
}

std::vector<Section> sections_of(const ResultsReportInput& input, bool has_opening) {
  std::vector<Section> sections{summary_section(input, has_opening)};
  if (sections[0].blocks.empty()) sections.clear();
  std::optional<std::string> setup;
  for (const ResultsBlock& block : input.view.blocks()) {
    if (const std::string& of = block.conditions.front().setup; of != setup) {
      setup = of;
      add_grid_section(input, of, sections);
      for (const ResultsOverview& overview : input.view.overviews())
        if (overview.conditions.front().setup == of)
          sections.push_back(overview_section(input, overview));
    }
    sections.push_back(block_section(input, block));
  }
  const std::string maps = input.view.study().name + "-maps";
  const auto group = std::ranges::find(input.figures.groups, maps, &FigureGroup::id);
  if (group != input.figures.groups.end()) {
    Section section{maps, group->title, {}};
    section.blocks.emplace_back(gallery_of(*group));
    sections.push_back(std::move(section));
  }
  if (!input.cost.empty()) {
    Section section{input.view.study().name + "-cost", "Cost", {}};
    for (const Table& table : input.cost) section.blocks.emplace_back(table);
    sections.push_back(std::move(section));
  }
  sections.push_back({input.view.study().name + "-provenance", "Provenance", input.provenance});
  return sections;
}

}  // namespace

std::vector<Block> given_provenance(const ResultsView& view, const std::string& command) {
  const ResultsStudy& study = view.study();
  std::vector<Block> blocks;
  blocks.emplace_back(
      plain("Another program made these results. Every number here is one of results.csv or is "
            "computed from its rows; this command writes the report again:"));
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

std::vector<Section> results_sections(const ResultsReportInput& input) {
  std::vector<Section> sections = sections_of(input, false);
  for (Section& section : sections) section.title = input.view.study().title + ": " + section.title;
  return sections;
}

Report results_report(const ResultsReportInput& input) {
  const ResultsStudy& study = input.view.study();
  Report report;
  report.title = study.title;
  report.subtitle = fmt::format(
      "{}, {}", counted(static_cast<long long>(study.methods.size()), "method"),
      counted(static_cast<long long>(input.view.runs()), study.runs.empty() ? "run" : "data set"));
  report.sections = sections_of(input, true);
  if (input.conclusions.empty())
    for (std::string& headline : headlines_of(input.view, input.comparisons))
      report.opening.findings.push_back(plain(std::move(headline)));
  else
    for (const std::string& conclusion : input.conclusions)
      if (report.opening.findings.size() < kFewComparisons)
        report.opening.findings.push_back(plain(conclusion));
  for (const FigureGroup& group : input.figures.groups)
    if (!group.figures.empty() && report.opening.figure_ids.size() < kMostThumbnails)
      report.opening.figure_ids.push_back(group.figures.front().id);
  report.footer = input.footer;
  return report;
}

}  // namespace mapproof
