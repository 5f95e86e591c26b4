#include "reports/sections/results/results_report.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/provenance.hpp"
#include "reports/sections/results/path_error_figures.hpp"
#include "reports/sections/results/results_data_sets.hpp"
#include "reports/sections/results/results_figures.hpp"
#include "reports/sections/results/results_opening.hpp"
#include "reports/sections/results/results_tables.hpp"
#include "reports/sections/results/results_view.hpp"
#include "reports/sections/topics/topic_means.hpp"
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
  Section section{study.name + "-summary", "Summary", {}};
  if (!study.question.empty() && !has_opening) section.blocks.emplace_back(plain(study.question));
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

/// Why quantities have no figure, those with the same reason in one sentence.
std::vector<std::string> why_no_figures(const ResultsView& view, const ResultsBlock& block) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;  // And the labels.
  for (const Quantity* quantity : view.quantities(block)) {
    const std::string why = why_no_figure(view, block, *quantity);
    if (why.empty()) continue;
    const std::string reason = why.substr(quantity->label.size());
    const auto known = std::ranges::find(reasons, reason, &decltype(reasons)::value_type::first);
    if (known == reasons.end())
      reasons.push_back({reason, {quantity->label}});
    else
      known->second.push_back(quantity->label);
  }
  std::vector<std::string> sentences;
  for (const auto& [reason, labels] : reasons)
    sentences.push_back(fmt::format("{}{}", fmt::join(labels, "; "), reason));
  return sentences;
}

Section block_section(const ResultsReportInput& input, const ResultsBlock& block) {
  Section section{block.id, block.title, {}};
  const auto group = std::ranges::find(input.figures.groups, block.id, &FigureGroup::id);
  if (group != input.figures.groups.end()) section.blocks.emplace_back(gallery_of(*group));
  for (std::string& why : why_no_figures(input.view, block))
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
  const std::string id = heat_maps_id(input.view, setup);
  const auto group = std::ranges::find(input.figures.groups, id, &FigureGroup::id);
  if (group == input.figures.groups.end()) return;
  sections.push_back({id, group->title, {gallery_of(*group)}});
}

/// A section's title without the setup's name, under which it stands: "noise 0.1 m" of "Indoors,
/// noise 0.1 m".
std::string title_within(const std::string& setup, const std::string& title) {
  for (const std::string_view mark : {", ", ": "})
    if (title.starts_with(setup + std::string(mark)))
      return title.substr(setup.size() + mark.size());
  return title;
}

/// Puts a setup's sections under its name; its only one stays alone.
void put_under(const std::string& setup, std::span<Section> sections) {
  if (setup.empty() || sections.size() < 2) return;
  for (Section& section : sections) {
    section.title = title_within(setup, section.title);
    section.group = setup;
  }
}

std::vector<Section> sections_of(const ResultsReportInput& input, bool has_opening) {
  std::vector<Section> sections{summary_section(input, has_opening)};
  if (sections[0].blocks.empty()) sections.clear();
  const std::vector<Label>& setups = input.view.study().setups;
  const std::vector<ResultsBlock>& blocks = input.view.blocks();
  for (auto block = blocks.begin(); block != blocks.end();) {
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
  report.sections = sections_of(input, true);
  report.opening = results_opening(input);
  report.footer = input.footer;
  report.date = input.date;
  return report;
}

}  // namespace mapproof
