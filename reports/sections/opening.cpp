#include "reports/sections/opening.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/findings.hpp"
#include "reports/sections/method_ranks.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/study_counts.hpp"
#include "reports/sections/tables/method_tables.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kNoBreak = "\u00a0";

/// With no break between number and unit.
std::string whole_metres(double value) {
  std::string text = error_text(value);
  const std::size_t space = text.find(' ');
  return space == std::string::npos ? text : text.replace(space, 1, kNoBreak);
}

/// One sensor and its methods, each at its best parameter.
struct SensorMethods {
  const SensorStudy* study = nullptr;
  std::vector<SettingSummary> methods;

  std::string section() const { return fmt::format("methods-{}", name(study->sensor.sensor)); }
};

std::vector<SensorMethods> methods_of(const Study& study) {
  std::vector<SensorMethods> all;
  for (const SensorStudy& sensor : study.experiment.sensors)
    all.push_back({&sensor, best_of_each_method(summarize(study, sensor, last_step(sensor)))});
  return all;
}

/// "Yairi 2007" of "Yairi 2007, Table 1" and "Yairi 2007, Table 2".
std::string sources_of(const std::vector<SensorMethods>& sensors) {
  std::vector<std::string> sources;
  for (const SensorMethods& sensor : sensors) {
    const std::string& whole = sensor.study->published.source;
    const std::string source = whole.substr(0, whole.find(','));
    if (!source.empty() && std::ranges::find(sources, source) == sources.end())
      sources.push_back(source);
  }
  return listed(sources, 2);
}

/// How the published errors compare with ours.
void add_agreement(const std::vector<SensorMethods>& sensors, Highlights& numbers) {
  PublishedAgreement all;
  for (const SensorMethods& sensor : sensors) all += agreement_of(sensor.methods);
  if (all.compared == 0) return;
  const int outside = all.compared - all.within;
  std::string detail = sources_of(sensors) + ": ";
  detail += outside == 0 ? "none outside"
            : outside == all.ours_smaller
                ? fmt::format("in the other {} ours is smaller", outside)
                : fmt::format("ours is smaller in {} of the other {}", all.ours_smaller, outside);
  if (all.apart > 0) detail += fmt::format("; {} more cannot be compared", all.apart);
  numbers.items.push_back({.label = "published errors inside our 95\u00a0% intervals",
                           .value = fmt::format("{} of {}", all.within, all.compared),
                           .detail = std::move(detail),
                           .section = sensors.front().section(),
                           .table = paper_table_id(*sensors.front().study, "accuracy")});
}

/// What the maps are compared with: always with the world, and with a paper if it prints errors.
Paragraph compared_with(const std::vector<SensorMethods>& sensors) {
  PublishedAgreement all;
  for (const SensorMethods& sensor : sensors) all += agreement_of(sensor.methods);
  return plain(all.compared + all.apart > 0 ? ": the published errors, and the ground truth."
                                            : ": the ground truth, and each other.");
}

/// Which of the published orderings of methods hold here.
void add_orderings(const Study& study, const std::vector<SensorMethods>& sensors,
                   Highlights& numbers) {
  int tried = 0, held = 0, significant = 0;
  const SensorMethods* first = nullptr;  // Of which an ordering was tried.
  for (const SensorMethods& sensor : sensors)
    for (const OrderingClaim& claim : ordering_claims(study, *sensor.study)) {
      if (!claim.difference_m) continue;
      ++tried;
      if (first == nullptr) first = &sensor;
      held += claim.holds() ? 1 : 0;
      significant += claim.holds() && claim.is_significant() ? 1 : 0;
    }
  if (first != nullptr)
    numbers.items.push_back({.label = "published orderings of methods hold",
                             .value = fmt::format("{} of {}", held, tried),
                             .detail = fmt::format("{} of them significantly", significant),
                             .section = first->section(),
                             .table = ordering_table_id(*first->study)});
}

void add_best(const SensorMethods& sensor, Highlights& numbers) {
  const std::string label_text = "best MPE by " + lower_case(title_of(sensor.study->sensor.sensor));
  const SettingSummary* best = best_of(sensor.methods);
  if (best == nullptr) {
    numbers.items.push_back({label_text, kMissingText, "no map could be scored", sensor.section()});
    return;
  }
  std::string detail = label(best->setting);
  if (const SettingSummary* paper = best_published(sensor.methods))
    detail = fmt::format("best published: {}, {}; ours: {}", whole_metres(paper->published->mpe_m),
                         info(paper->setting.method).label, detail);
  numbers.items.push_back({.label = label_text,
                           .value = whole_metres(best->mpe_m->mean),
                           .detail = std::move(detail),
                           .section = sensor.section(),
                           .table = paper_table_id(*sensor.study, "accuracy")});
}

void add_ends(const StudyCounts& counts, Highlights& numbers) {
  if (counts.maps == 0) return;
  numbers.items.push_back({fmt::format("of {} without a warning", counted(counts.maps, "map")),
                           fmt::format("{} %", 100 - warned_percent(counts)),
                           counts.unscored == 0
                               ? "all could be scored"
                               : count_text(counts.unscored) + " could not be scored",
                           "warnings"});
}

/// "Maps of 50 landmarks built from what a simulated robot observed, without ever estimating its
/// pose: 10 methods, visibility and bearing, 25 runs."
Paragraph what_was_done(const Study& study) {
  std::set<Method> methods;
  std::vector<std::string> sensors;
  for (const SensorStudy& sensor : study.experiment.sensors) {
    sensors.push_back(lower_case(title_of(sensor.sensor.sensor)));
    for (const MethodGrid& grid : sensor.methods) methods.insert(grid.method);
  }
  std::string text = fmt::format(
      "Maps of {} built from what a simulated robot observed, without ever estimating its pose: "
      "{}, {}, {}.",
      counted(study.experiment.world.landmarks, "landmark"), counted(std::ssize(methods), "method"),
      listed(sensors, 6), counted(std::ssize(study.runs), "run"));
  return plain(text + " MPE is the mean position error of the landmarks that are not anchors.");
}

/// "arbitrary neighbours (12 maps) and not converged (6 maps)": the most frequent first.
std::string frequent_warnings(const Study& study, const StudyCounts& counts) {
  std::map<std::string, int> maps;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records) {
      std::set<std::string> codes;
      for (const Status& status : record.statuses) codes.insert(words_of(status.code));
      for (const std::string& code : codes) ++maps[code];
    }
  std::vector<std::pair<std::string, int>> order(maps.begin(), maps.end());
  std::ranges::stable_sort(order, std::greater(), &std::pair<std::string, int>::second);
  std::vector<std::string> names;
  for (const auto& [code, count] : order)
    names.push_back(
        fmt::format("{} ({} map{})", code, count_text(count, counts.maps), count == 1 ? "" : "s"));
  return listed(names, 3);
}

/// What is missing, what ended badly, and in what the study is smaller than the paper's.
Paragraph what_is_wrong(const Study& study) {
  const Experiment& experiment = study.experiment;
  const StudyCounts counts = count(study);
  const long planned = static_cast<long>(experiment.layouts) * experiment.poses;
  std::string text;
  if (static_cast<long>(study.runs.size()) < planned)
    text += done_text(std::ssize(study.runs), planned, "run") + ". ";
  if (counts.maps > 0) text += capitalised(endings_text(counts)) + ". ";
  if (counts.with_status > 0)
    text += fmt::format("Most frequent: {}. ", frequent_warnings(study, counts));
  if (const std::string smaller = smaller_than_paper(experiment); !smaller.empty())
    text += "Not the paper\u2019s protocol: " + smaller;
  if (text.empty()) text = "No map was made.";
  while (text.ends_with(' ')) text.pop_back();
  return plain(": " + text);
}

/// The first figure or scene of the group; empty if there is none.
std::string first_of(const StudyFigures& figures, const std::string& group) {
  const auto found = std::ranges::find(figures.groups, group, &FigureGroup::id);
  if (found == figures.groups.end()) return "";
  return found->figures.empty() ? found->scenes.front().id : found->figures.front().id;
}

/// What [yairi2007, section 4.1] ran.
constexpr int kPaperLayouts = 5;
constexpr int kPaperPoses = 5;
constexpr int kPaperSteps = 2000;
constexpr int kPaperLandmarks = 50;

}  // namespace

std::string smaller_than_paper(const Experiment& experiment) {
  const bool yairi = std::ranges::any_of(experiment.sensors, [](const SensorStudy& sensor) {
    return sensor.published.source.starts_with("Yairi 2007");
  });
  if (!yairi) return "";
  std::string text;
  if (experiment.layouts < kPaperLayouts || experiment.poses < kPaperPoses)
    text += fmt::format("{} of {} each where the paper averaged {} of {} each. ",
                        counted(experiment.layouts, "layout"),
                        counted(experiment.poses, "initial pose"), counted(kPaperLayouts, "layout"),
                        counted(kPaperPoses, "initial pose"));
  for (const SensorStudy& sensor : experiment.sensors)
    if (last_step(sensor) < kPaperSteps)
      text += fmt::format("{} stops at {}, the paper at {}. ", title_of(sensor.sensor.sensor),
                          counted(last_step(sensor), "observation"), kPaperSteps);
  if (experiment.world.landmarks != kPaperLandmarks)
    text += fmt::format("{} where the paper had {}. ",
                        counted(experiment.world.landmarks, "landmark"), kPaperLandmarks);
  return text;
}

std::vector<std::string> in_turns(const std::vector<std::vector<std::string>>& lists) {
  std::vector<std::string> ids;
  std::size_t turns = 0;
  for (const std::vector<std::string>& own : lists) turns = std::max(turns, own.size());
  for (std::size_t turn = 0; turn < turns; ++turn)
    for (const std::vector<std::string>& own : lists)
      if (turn < own.size()) ids.push_back(own[turn]);
  return ids;
}

std::vector<std::string> present_ids(const std::vector<std::string>& ids,
                                     const StudyFigures& figures, std::size_t most) {
  std::vector<std::string> there, chosen;
  for (const Figure* figure : all_figures(figures)) there.push_back(figure->id);
  for (const Scene* scene : all_scenes(figures)) there.push_back(scene->id);
  for (const std::string& id : ids)
    if (chosen.size() < most && std::ranges::find(there, id) != there.end() &&
        std::ranges::find(chosen, id) == chosen.end())
      chosen.push_back(id);
  return chosen;
}

void choose_figures(const std::vector<std::string>& ids, const StudyFigures& figures,
                    Opening& opening, const std::vector<std::string>& evidence) {
  opening.figure_ids = present_ids(ids, figures, kMostCandidates);
  if (const auto shown = present_ids(evidence, figures, 1); !shown.empty()) {
    opening.main_figure = shown.front();
    std::erase(opening.figure_ids, opening.main_figure);
    return;
  }
  if (opening.figure_ids.empty()) return;
  // One that found something, if there is any.
  const auto found_nothing = [&](const std::string& id) {
    return std::ranges::any_of(all_figures(figures), [&](const Figure* figure) {
      return figure->id == id && (figure->title.find(kNoneIsBest) != std::string::npos ||
                                  figure->title.find(kTooFewRuns) != std::string::npos);
    });
  };
  auto main_figure = std::ranges::find_if_not(opening.figure_ids, found_nothing);
  if (main_figure == opening.figure_ids.end()) main_figure = opening.figure_ids.begin();
  opening.main_figure = *main_figure;
  opening.figure_ids.erase(main_figure);
}

std::string today_utc() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))); }

std::string date_of(std::span<const Session> sessions) {
  constexpr std::size_t kDateSize = 10;  // "2026-11-26"
  return sessions.empty() ? "" : sessions.back().started_utc.substr(0, kDateSize);
}

Opening study_opening(const Study& study, const StudyFigures& figures) {
  const std::vector<SensorMethods> sensors = methods_of(study);
  Opening opening;
  if (!sensors.empty()) {
    add_agreement(sensors, opening.numbers);
    add_orderings(study, sensors, opening.numbers);
  }
  std::vector<std::string> ids = {"published-errors"};
  for (const SensorMethods& sensor : sensors) {
    add_best(sensor, opening.numbers);
    if (const SettingSummary* best = best_of(sensor.methods))
      ids.push_back(fmt::format("map-{}-{}", name(best->sensor), info(best->setting.method).name));
  }
  const StudyCounts counts = count(study);
  add_ends(counts, opening.numbers);
  if (counts.with_status + counts.unscored + counts.failed > 0)
    opening.warnings.push_back(endings_text(counts));
  opening.findings = {what_was_done(study)};
  opening.wrong = what_is_wrong(study);
  opening.compared_with = compared_with(sensors);
  ids.push_back(first_of(figures, "scenes"));
  if (!sensors.empty())
    ids.push_back(fmt::format("scene-manifold-{}", name(sensors.back().study->sensor.sensor)));
  for (const char* group : {"curves", "forming", "observations", "parameters"})
    ids.push_back(first_of(figures, group));
  choose_figures(ids, figures, opening);
  return opening;
}

}  // namespace mapproof
