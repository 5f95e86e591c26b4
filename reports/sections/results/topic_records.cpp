#include "reports/sections/results/topic_records.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/maps/pair_distances.hpp"
#include "reports/sections/figures/map_scenes.hpp"
#include "reports/sections/figures/map_walls.hpp"
#include "reports/sections/provenance.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/results/results_curves.hpp"
#include "reports/sections/results/results_distributions.hpp"
#include "reports/sections/results/results_view.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

bool is_of_data(const TopicStudy& study) { return !study.experiment.data.empty(); }

std::size_t planned_parts(const TopicExperiment& experiment) {
  if (!experiment.data.empty()) return experiment.data.size();
  return static_cast<std::size_t>(experiment.layouts) * static_cast<std::size_t>(experiment.poses);
}

std::string title_of(const TopicStudy& study, const std::string& part) {
  const auto set = std::ranges::find(study.experiment.data, part, &DataSet::id);
  return set == study.experiment.data.end() ? part : set->title;
}

void add_extent(const TopicStudy& study, KeyValues& facts) {
  const TopicExperiment& experiment = study.experiment;
  if (is_of_data(study)) {
    for (const DataSet& set : experiment.data)
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

/// ", the 95 % ellipses of 30 of 46 landmarks hold the true position": without anchors.
std::string ellipses_text(const MapRecord& map, const MapUncertainty& uncertainty) {
  int ellipses = 0, hold = 0;
  for (Eigen::Index i = 0; map.ground_truth_m && i < map.estimate.rows(); ++i) {
    const Eigen::RowVector2d position = map.estimate.row(i), point = map.ground_truth_m->row(i);
    if (is_anchor(map, i) || !position.allFinite() || !point.allFinite()) continue;
    if (!confidence_ellipse(uncertainty, i)) continue;
    ++ellipses;
    hold += covers(uncertainty, i, position, point) ? 1 : 0;
  }
  if (ellipses == 0 || map.frame != Frame::kGroundTruth)
    return ", 95\u00a0% ellipses by the bootstrap";
  return fmt::format(", the 95\u00a0% ellipses of {} of {} landmarks hold the true position", hold,
                     ellipses);
}

/// "dataset1: Range and bearing, SMACOF once".
std::string name_of(const TopicStudy& study, const TopicPart& part, const TopicMap& map) {
  const auto setup = std::ranges::find(study.design.setups, map.at.setup.get(), &TopicSetup::id);
  std::string title = is_of_data(study) || setup == study.design.setups.end()
                          ? title_of(study, part.id)
                          : setup->title;
  if (setup != study.design.setups.end() && !setup->factors.empty())
    title += ", " + level_words(*setup, map.at);
  return title + ": " + series_label(study.design, map.method);
}

/// With its error.
std::string title_of(const TopicStudy& study, const TopicPart& part, const TopicMap& map) {
  const std::string name = name_of(study, part, map);
  const auto& score = map.map.score;
  if (!score) return name;
  if (!is_usable(*score)) return name + kNoUsableMap;
  return std::isfinite(score->mpe_m) ? name + ": " + error_text(score->mpe_m) + " off" : name;
}

bool has_a_position(const MapRecord& map) {
  for (Eigen::Index i = 0; i < map.estimate.rows(); ++i)
    if (map.estimate.row(i).allFinite()) return true;
  return false;
}

/// "No landmark has a position: dataset1: Bearing, CMDS; dataset1: Range, CMDS; 3 more."
std::string words_of_empty(std::vector<std::string> names) {
  if (names.empty()) return "";
  constexpr std::size_t kMost = 12;
  if (names.size() > kMost) {
    const std::size_t more = names.size() - (kMost - 1);
    names.resize(kMost - 1);
    names.push_back(fmt::format("{} more", more));
  }
  return fmt::format("No landmark has a position: {}.", fmt::join(names, "; "));
}

}  // namespace

FigureGroup topic_maps(const TopicStudy& study, const std::string& prefix) {
  FigureGroup maps{prefix + "-maps", "Maps", "", {}};
  std::vector<std::pair<std::string, const MapRecord*>> named;
  std::vector<std::string> empty;
  std::vector<Figure> singly;
  std::vector<MapInSpace> in_space;
  for (const TopicPart& part : study.parts)
    for (const TopicMap& map : part.maps) {
      if (!has_a_position(map.map)) {
        empty.push_back(name_of(study, part, map));
        continue;
      }
      named.emplace_back(name_of(study, part, map), &map.map);
      const std::string title = title_of(study, part, map);
      const std::string ellipses =
          map.uncertainty ? ellipses_text(map.map, *map.uncertainty) : std::string();
      singly.push_back(
          measured_map_figure({id_below(prefix, "map-" + slug_of(map.id)), title + ellipses,
                               map.map, map.pairs, map.uncertainty}));
      if (!map.pairs.empty())
        singly.push_back(pair_distances_figure({id_below(prefix, "pairs-" + slug_of(map.id)),
                                                title + ", measured pairs", map.map, map.pairs}));
      in_space.push_back({title, series_label(study.design, map.method), &map.map});
    }
  maps.words = words_of_empty(std::move(empty));
  maps.figures = map_walls(prefix, named);
  std::ranges::move(singly, std::back_inserter(maps.figures));
  maps.scenes = best_map_scene("scene-" + prefix + "-map", in_space);
  return maps;
}

FigureGroup topic_evidence(const TopicStudy& study, const ResultsStudy& results,
                           const TopicHeadline& headline) {
  FigureGroup group{summary_id(results.name), "Summary", "", {}};
  const ResultsStudy evidence = evidence_of(study, results);
  if (headline.value.empty() || evidence.results.rows.empty()) return group;
  const ResultsView view(evidence);
  const Quantity& quantity = view.quantity(evidence.quantities.front());
  std::optional<Figure> figure;
  if (!view.overviews().empty())
    figure = overview_figure(view, view.overviews().front(), quantity);
  else if (view.blocks().front().has_axis())
    figure = curve_figure(view, view.blocks().front(), quantity);
  else
    figure = means_figure(view, view.blocks().front(), quantity);
  if (!figure) return group;
  figure->id = id_below(results.name, "headline");
  figure->columns = 2;  // Names of setups are long.
  figure->title = capitalised(headline.value + " " + headline.label);
  group.figures.push_back(*std::move(figure));
  return group;
}

std::optional<Table> topic_seconds_table(const TopicStudy& study, const std::string& prefix) {
  if (!is_of_data(study)) return std::nullopt;
  Table table;
  table.id = "seconds--" + prefix;
  table.caption = "What it took";
  table.columns.push_back({"Method", "", "", ""});
  for (const TopicPart& part : study.parts)
    table.columns.push_back({title_of(study, part.id), "s", "", ""});
  for (const StudiedMethod& method : study.design.methods) {
    Row line{{TextCell{method.label}}, "", false};
    bool any = false;
    for (const TopicPart& part : study.parts) {
      const auto timing = std::ranges::find(part.seconds, method.id, &MethodSeconds::method);
      any |= timing != part.seconds.end();
      line.cells.push_back(timing == part.seconds.end() ? Cell(MissingCell{})
                                                        : NumberCell{timing->seconds, 3});
    }
    if (any) table.rows.push_back(std::move(line));
  }
  table.notes.emplace_back(
      "Seconds of making the map; reading the files is not part of them. They differ from one "
      "start of the program to the next; what the whole study took is under Provenance.");
  if (table.rows.empty()) return std::nullopt;
  return table;
}

std::string topic_incomplete(const TopicStudy& study) {
  return incomplete_text(std::ssize(study.parts),
                         static_cast<long long>(planned_parts(study.experiment)),
                         is_of_data(study) ? "data set" : "run");
}

std::vector<Block> topic_provenance(const TopicStudy& study, std::span<const Session> sessions,
                                    const std::string& command, const std::string& prefix) {
  const TopicExperiment& experiment = study.experiment;
  std::vector<Block> blocks;
  blocks.emplace_back(
      plain("Every number here comes from the study\u2019s records; this command makes them and "
            "this report again, to the byte (seconds aside):"));
  blocks.emplace_back(KeyValues{{{"Command", {command, Emphasis::kCode}}}});
  KeyValues facts;
  facts.items.push_back({"Study", {experiment.name, Emphasis::kData}});
  facts.items.push_back({"Seed", {fmt::format("{}", experiment.seed), Emphasis::kData}});
  add_extent(study, facts);
  for (const auto& [name, values] : experiment.options) {
    std::string words = name;
    std::ranges::replace(words, '_', ' ');
    facts.items.push_back({words, {fmt::format("{:g}", fmt::join(values, ", ")), Emphasis::kData}});
  }
  blocks.emplace_back(std::move(facts));
  blocks.emplace_back(provenance_items(study.provenance));
  if (!sessions.empty()) blocks.emplace_back(sessions_table("sessions--" + prefix, sessions));
  return blocks;
}

}  // namespace mapproof
