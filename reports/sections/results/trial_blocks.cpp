#include "reports/sections/results/trial_blocks.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text/words.hpp"
#include "render/figures/maps/pair_distances.hpp"
#include "reports/sections/provenance.hpp"
#include "reports/sections/results/results_view.hpp"
#include "reports/sections/trials/trial_means.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

bool is_of_data(const TrialStudy& study) { return !study.experiment.data.empty(); }

std::size_t planned_parts(const TrialExperiment& experiment) {
  if (!experiment.data.empty()) return experiment.data.size();
  return static_cast<std::size_t>(experiment.layouts) * static_cast<std::size_t>(experiment.poses);
}

std::string title_of(const TrialStudy& study, const std::string& part) {
  const auto set = std::ranges::find(study.experiment.data, part, &TrialDataSet::id);
  return set == study.experiment.data.end() ? part : set->title;
}

void add_extent(const TrialStudy& study, KeyValues& facts) {
  const TrialExperiment& experiment = study.experiment;
  if (is_of_data(study)) {
    for (const TrialDataSet& set : experiment.data)
      facts.items.push_back({set.title, {"SHA-256 " + set.digest, Emphasis::kCode}});
    return;
  }
  facts.items.push_back({"Runs",
                         {fmt::format("{}, {} each", counted(experiment.layouts, "layout"),
                                      counted(experiment.poses, "initial pose")),
                          Emphasis::kPlain}});
  facts.items.push_back(
      {"Landmarks", {fmt::format("{}", experiment.world.landmarks), Emphasis::kPlain}});
  facts.items.push_back({"Steps", {fmt::format("{}", experiment.steps), Emphasis::kPlain}});
}

std::string title_of(const TrialStudy& study, const TrialPart& part, const TrialMap& map) {
  const auto setup = std::ranges::find(study.design.setups, map.at.setup, &TrialSetup::id);
  std::string title = is_of_data(study) || setup == study.design.setups.end()
                          ? title_of(study, part.id)
                          : setup->title;
  if (setup != study.design.setups.end() && !setup->factors.empty())
    title += ", " + level_words(*setup, map.at);
  title += ": " + series_label(study.design, map.series);
  if (map.certainty) title += ", 95\u00a0% ellipses by the bootstrap";
  return title;
}

}  // namespace

FigureGroup trial_maps(const TrialStudy& study, const std::string& prefix) {
  FigureGroup maps{prefix + "-maps", "Maps", "", {}};
  for (const TrialPart& part : study.parts)
    for (const TrialMap& map : part.maps) {
      const std::string title = title_of(study, part, map);
      maps.figures.push_back(measured_map_figure(
          {prefix + "-map-" + slug_of(map.id), title, map.map, map.pairs, map.certainty}));
      if (!map.pairs.empty())
        maps.figures.push_back(
            pair_distances_figure({prefix + "-pairs-" + slug_of(map.id), title + ", measured pairs",
                                   map.map, map.pairs}));
    }
  return maps;
}

std::optional<Table> trial_seconds_table(const TrialStudy& study, const std::string& prefix) {
  if (!is_of_data(study)) return std::nullopt;
  Table table;
  table.id = "seconds--" + prefix;
  table.caption = "What it took";
  table.columns.push_back({"Method", "", "", ""});
  for (const TrialPart& part : study.parts)
    table.columns.push_back({title_of(study, part.id), "s", "", ""});
  for (const TrialSeries& series : study.design.series) {
    Row line{{TextCell{series.label}}, "", false};
    bool any = false;
    for (const TrialPart& part : study.parts) {
      const auto timing = std::ranges::find(part.seconds, series.id, &TrialSeconds::series);
      any |= timing != part.seconds.end();
      line.cells.push_back(timing == part.seconds.end() ? Cell(MissingCell{})
                                                        : NumberCell{timing->seconds, 3});
    }
    if (any) table.rows.push_back(std::move(line));
  }
  table.notes.emplace_back(
      "Seconds of making the map; reading the files is not part of them. They differ from one run "
      "of the program to the next; what the whole run took is under Provenance.");
  if (table.rows.empty()) return std::nullopt;
  return table;
}

std::string trial_incomplete(const TrialStudy& study) {
  const std::size_t planned = planned_parts(study.experiment);
  if (study.parts.size() >= planned) return "";
  return fmt::format(
      "{} of {} are done; every number below rests on these.", study.parts.size(),
      counted(static_cast<long long>(planned), is_of_data(study) ? "data set" : "run"));
}

std::vector<Block> trial_provenance(const TrialStudy& study, std::span<const Session> sessions,
                                    const std::string& command, const std::string& prefix) {
  const TrialExperiment& experiment = study.experiment;
  std::vector<Block> blocks;
  blocks.emplace_back(
      plain("Every number here comes from the study\u2019s records; this command makes them and "
            "this report again, to the byte (seconds aside):"));
  blocks.emplace_back(KeyValues{{{"Command", {command, Emphasis::kCode}}}});
  KeyValues facts;
  facts.items.push_back({"Study", {experiment.name, Emphasis::kData}});
  facts.items.push_back({"Seed", {fmt::format("{}", experiment.seed), Emphasis::kData}});
  add_extent(study, facts);
  for (const auto& [name, values] : experiment.options)
    facts.items.push_back({name, {fmt::format("{:g}", fmt::join(values, ", ")), Emphasis::kData}});
  blocks.emplace_back(std::move(facts));
  blocks.emplace_back(provenance_items(study.provenance));
  if (!sessions.empty()) blocks.emplace_back(sessions_table("sessions--" + prefix, sessions));
  return blocks;
}

}  // namespace mapproof
