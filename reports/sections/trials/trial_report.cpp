#include "reports/sections/trials/trial_report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/sections/sessions_table.hpp"
#include "reports/sections/trials/trial_means.hpp"
#include "reports/sections/trials/trial_tables.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

const FigureGroup* group_of(const StudyFigures& figures, const std::string& id) {
  const auto found = std::ranges::find(figures.groups, id, &FigureGroup::id);
  return found == figures.groups.end() ? nullptr : &*found;
}

std::size_t planned_parts(const TrialExperiment& experiment) {
  if (!experiment.data.empty()) return experiment.data.size();
  return static_cast<std::size_t>(experiment.layouts) * static_cast<std::size_t>(experiment.poses);
}

Section summary_section(const TrialReportInput& input) {
  const TrialStudy& study = input.study;
  Section section{id_prefix(study) + "-summary", "Summary", {}};
  section.blocks.emplace_back(plain(study.design.question));
  if (study.parts.size() < planned_parts(study.experiment))
    section.blocks.emplace_back(
        Callout{Callout::Tone::kWarning, "Incomplete",
                plain(fmt::format("{} of {} are done; every number below rests on these.",
                                  study.parts.size(),
                                  counted(static_cast<long long>(planned_parts(study.experiment)),
                                          is_of_data(study) ? "data set" : "run")))});
  BulletList findings;
  for (const std::string& conclusion : study.conclusions)
    findings.items.push_back({{{conclusion, Emphasis::kPlain}}});
  if (!findings.items.empty()) section.blocks.emplace_back(std::move(findings));
  return section;
}

Section setup_section(const TrialReportInput& input, const TrialSetup& setup) {
  const std::string id = id_prefix(input.study) + "-" + setup.id;
  Section section{id, setup.title, {}};
  if (const FigureGroup* group = group_of(input.figures, id))
    section.blocks.emplace_back(gallery_of(*group));
  for (Table& table : trial_tables(input.study, setup))
    section.blocks.emplace_back(std::move(table));
  return section;
}

void add_options(const TrialExperiment& experiment, KeyValues& facts) {
  for (const auto& [name, values] : experiment.options) {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + fmt::format("{:g}", value);
    facts.items.push_back({name, {text, Emphasis::kData}});
  }
}

Section provenance_section(const TrialReportInput& input) {
  const TrialExperiment& experiment = input.study.experiment;
  Section section{id_prefix(input.study) + "-provenance", "Provenance", {}};
  section.blocks.emplace_back(
      plain("Every number here comes from the study\u2019s records; this command makes them and "
            "this report again, to the byte (seconds aside):"));
  section.blocks.emplace_back(KeyValues{{{"Command", {input.command, Emphasis::kCode}}}});
  KeyValues facts;
  facts.items.push_back({"Study", {experiment.name, Emphasis::kData}});
  facts.items.push_back({"Seed", {fmt::format("{}", experiment.seed), Emphasis::kData}});
  if (is_of_data(input.study)) {
    for (const TrialDataSet& set : experiment.data)
      facts.items.push_back({set.title, {"SHA-256 " + set.digest, Emphasis::kCode}});
  } else {
    facts.items.push_back({"Runs",
                           {fmt::format("{}, {} each", counted(experiment.layouts, "layout"),
                                        counted(experiment.poses, "initial pose")),
                            Emphasis::kPlain}});
    facts.items.push_back(
        {"Landmarks", {fmt::format("{}", experiment.world.landmarks), Emphasis::kPlain}});
    facts.items.push_back({"Steps", {fmt::format("{}", experiment.steps), Emphasis::kPlain}});
  }
  add_options(experiment, facts);
  section.blocks.emplace_back(std::move(facts));
  section.blocks.emplace_back(provenance_items(input.study.provenance));
  if (!input.sessions.empty())
    section.blocks.emplace_back(
        sessions_table(id_prefix(input.study) + "-sessions", input.sessions));
  return section;
}

std::vector<Section> sections_of(const TrialReportInput& input) {
  std::vector<Section> sections{summary_section(input)};
  for (const TrialSetup& setup : input.study.design.setups)
    sections.push_back(setup_section(input, setup));
  const std::string maps = id_prefix(input.study) + "-maps";
  if (const FigureGroup* group = group_of(input.figures, maps)) {
    Section section{maps, group->title, {}};
    section.blocks.emplace_back(gallery_of(*group));
    sections.push_back(std::move(section));
  }
  for (Table& table : trial_seconds_tables(input.study)) {
    Section section{id_prefix(input.study) + "-cost", "Cost", {}};
    section.blocks.emplace_back(std::move(table));
    sections.push_back(std::move(section));
  }
  sections.push_back(provenance_section(input));
  return sections;
}

}  // namespace

std::vector<Section> trial_sections(const TrialReportInput& input) {
  std::vector<Section> sections = sections_of(input);
  for (Section& section : sections)
    section.title = input.study.experiment.title + ": " + section.title;
  return sections;
}

Report trial_report(const TrialReportInput& input) {
  const TrialExperiment& experiment = input.study.experiment;
  Report report;
  report.title = experiment.title;
  report.subtitle = fmt::format("{}, {}", experiment.name,
                                counted(static_cast<long long>(input.study.parts.size()),
                                        is_of_data(input.study) ? "data set" : "run"));
  report.sections = sections_of(input);
  report.footer = fmt::format("Made by mapproof {} ({}).", input.study.provenance.version,
                              input.study.provenance.commit);
  return report;
}

}  // namespace mapproof
