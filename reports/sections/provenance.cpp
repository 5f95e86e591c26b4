#include "reports/sections/provenance.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

Phrase data(std::string text) { return {std::move(text), Emphasis::kData}; }

std::string join(const std::vector<int>& values) {
  std::string text;
  for (const int value : values) text += (text.empty() ? "" : ", ") + count_text(value);
  return text;
}

std::string methods_of(const SensorStudy& sensor) {
  std::string text;
  for (const MethodGrid& grid : sensor.methods) {
    text += fmt::format("{}{}", text.empty() ? "" : "; ", info(grid.method).label);
    const auto& parameter = info(grid.method).parameter;
    if (grid.parameters.empty() || !parameter) continue;
    text += fmt::format(" ({} =", parameter->shown);
    for (std::size_t i = 0; i < grid.parameters.size(); ++i)
      text += fmt::format("{}{:g}", i == 0 ? " " : ", ", grid.parameters[i]);
    text += ")";
  }
  return text;
}

KeyValues experiment_items(const Experiment& experiment) {
  KeyValues items;
  items.items = {
      {"Experiment", data(experiment.name)},
      {"Seed", data(fmt::format("{}", experiment.seed))},
      {"Runs", data(fmt::format("{} \u00D7 {}", counted(experiment.layouts, "layout"),
                                counted(experiment.poses, "initial pose")))},
      {"Room",
       data(fmt::format("{:g} m \u00D7 {:g} m, {} of {:g} mm", experiment.world.side_m,
                        experiment.world.side_m, counted(experiment.world.landmarks, "landmark"),
                        1e3 * experiment.world.landmark_diameter_m))},
      {"Walk", data(fmt::format("steps of {:g} m, heading changes up to {:.4g} rad",
                                experiment.walk.step_m, experiment.walk.heading_change_rad))},
      {"Anchors", data(fmt::format("{}, nearest the corners", experiment.anchors))}};
  for (const SensorStudy& sensor : experiment.sensors) {
    const std::string title = title_of(sensor.sensor.sensor);
    items.items.push_back({title + " checkpoints", data(join(sensor.checkpoints))});
    items.items.push_back({title + " methods", data(methods_of(sensor))});
    if (sensor.sensor.noise > 0.0 || sensor.sensor.dropout_share > 0.0)
      items.items.push_back(
          {title + " faults", data(fmt::format("noise {:g}, dropout share {:g}",
                                               sensor.sensor.noise, sensor.sensor.dropout_share))});
  }
  for (const ExternalMethod& method : experiment.external_methods)
    items.items.push_back(
        {method.label,
         data(fmt::format("{}command: {}; gets {}, has {:g} s for a map",
                          method.source.empty() ? "" : method.source + "; ",
                          fmt::join(method.command, " "), name(method.input), method.timeout_s))});
  return items;
}

struct Duration {
  int maps = 0;
  double seconds = 0.0;
  double longest = 0.0;
};

using Durations = std::map<std::tuple<Sensor, Method>, Duration>;

Durations durations_of(std::span<const Timing> timings) {
  Durations durations;
  for (const Timing& timing : timings) {
    Duration& duration = durations[{timing.sensor, timing.setting.method}];
    ++duration.maps;
    duration.seconds += timing.seconds;
    duration.longest = std::max(duration.longest, timing.seconds);
  }
  return durations;
}

constexpr double kLeastToTell_s = 1.0;

/// Which method took most of the seconds; empty where there are hardly any.
std::optional<Paragraph> dominance(const Durations& durations) {
  std::map<Method, double> seconds;
  double sum = 0.0;
  for (const auto& [key, duration] : durations) {
    seconds[std::get<1>(key)] += duration.seconds;
    sum += duration.seconds;
  }
  if (sum < kLeastToTell_s) return std::nullopt;
  const auto most = std::ranges::max_element(seconds, {}, [](const auto& s) { return s.second; });
  return plain(
      fmt::format("{} takes the largest share of the time: {} % of the {} s that the maps "
                  "took over all threads, those of the variations aside.",
                  info(most->first).label, format_number(100.0 * most->second / sum, 0),
                  format_number(sum, 1)));
}

Table durations_table(const Durations& durations) {
  Table table;
  table.id = "durations";
  table.caption = "How long the maps took";
  table.columns = {{"Sensor", "", "", ""},    {"Method", "", "", ""},
                   {"Maps", "", "", ""},      {"Mean", "ms", "", "One map."},
                   {"Longest", "ms", "", ""}, {"Sum", "s", "", "Over all threads."}};
  for (const auto& [key, duration] : durations)
    table.rows.push_back(
        {{TextCell{title_of(std::get<0>(key))}, TextCell{std::string(info(std::get<1>(key)).label)},
          NumberCell{static_cast<double>(duration.maps), 0},
          NumberCell{1e3 * duration.seconds / duration.maps, 2},
          NumberCell{1e3 * duration.longest, 2}, NumberCell{duration.seconds, 2}},
         "",
         false});
  table.notes.push_back(
      "Seconds differ from one start of the program to the next and are not part of any "
      "comparison.");
  return table;
}

}  // namespace

Table sessions_table(std::string id, std::span<const Session> sessions) {
  Table table;
  table.id = std::move(id);
  table.caption = "Starts of the program on this study";
  table.columns = {{"Started (UTC)", "", "", ""},
                   {"Command", "", "", ""},
                   {"Host", "", "", ""},
                   {"Jobs", "", "", ""},
                   {"Duration", "s", "", "Wall clock; the records alone, without figures."},
                   {"Peak memory", "MiB", "", "Of the process, until its records were made."}};
  for (const Session& session : sessions)
    table.rows.push_back(
        {{TextCell{session.started_utc, Emphasis::kData},
          TextCell{session.command, Emphasis::kCode}, TextCell{session.host, Emphasis::kData},
          NumberCell{static_cast<double>(session.jobs), 0}, NumberCell{session.seconds, 1},
          session.peak_memory_mib ? Cell{NumberCell{*session.peak_memory_mib, 0}}
                                  : Cell{MissingCell{}}},
         "",
         false});
  return table;
}

Section provenance_section(const Study& study, std::span<const Session> sessions,
                           std::span<const Timing> timings, const std::string& command) {
  Section section{"provenance", "Provenance", {}, "", Interest::kFew};
  section.blocks.emplace_back(
      plain("Every number here comes from the study\u2019s records; this command makes them and "
            "this report again, to the byte (durations aside):"));
  section.blocks.emplace_back(KeyValues{{{"Command", {command, Emphasis::kCode}}}});
  section.blocks.emplace_back(experiment_items(study.experiment));
  section.blocks.emplace_back(provenance_items(study.provenance));
  if (!sessions.empty()) fold(sessions_table("sessions", sessions), section);
  if (timings.empty()) return section;
  const Durations durations = durations_of(timings);
  if (auto most = dominance(durations)) section.blocks.emplace_back(*std::move(most));
  fold(durations_table(durations), section);
  return section;
}

}  // namespace mapproof
