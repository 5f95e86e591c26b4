#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/findings.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/study_counts.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

/// What [yairi2007, section 4.1] ran.
constexpr int kPaperLayouts = 5;
constexpr int kPaperPoses = 5;
constexpr int kPaperSteps = 2000;
constexpr int kPaperLandmarks = 50;

void add_sensor(const Study& study, const SensorStudy& sensor, BulletList& findings,
                Highlights& highlights) {
  const auto methods = best_of_each_method(summarize(study, sensor, last_step(sensor)));
  const SettingSummary* best = best_of(methods);
  const std::string title = title_of(sensor.sensor.sensor);
  if (best == nullptr) {
    findings.items.push_back({{strong(title), phrase(": no map could be scored.")}});
    highlights.items.push_back({title + ", best MPE", kMissingText, "no map could be scored"});
    return;
  }
  std::ranges::move(sensor_findings(study, sensor, methods).items,
                    std::back_inserter(findings.items));
  std::string detail = label(best->setting);
  if (best->published) detail += "; paper: " + metres(best->published->mpe_m);
  highlights.items.push_back({title + ", best MPE", metres(best->mpe_m->mean), detail});
}

void add_ends(const Study& study, BulletList& findings, Highlights& highlights) {
  const StudyCounts counts = count(study);
  const Experiment& experiment = study.experiment;
  const long planned = static_cast<long>(experiment.layouts) * experiment.poses;
  highlights.items.push_back({"Runs", fmt::format("{} of {}", study.runs.size(), planned),
                              fmt::format("{}, {} each", counted(experiment.layouts, "layout"),
                                          counted(experiment.poses, "initial pose"))});
  highlights.items.push_back({"Maps with a status",
                              fmt::format("{} of {}", counts.with_status, counts.maps),
                              fmt::format("{} without a score", counts.unscored)});
  if (counts.maps == 0) return;
  const std::string maps = counted(counts.maps, "map");
  const std::string text =
      counts.with_status + counts.unscored == 0
          ? fmt::format(": none: every one of {} ended well.", maps)
          : fmt::format(
                ": of {}, {} without a score and {} with a status, all listed below with "
                "the reason.",
                maps, counts.unscored, counts.with_status);
  findings.items.push_back({{strong("Failures"), phrase(text)}});
}

/// In what the study is smaller than the paper's; empty if in nothing.
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
      text += fmt::format("{} stops at {} observations, the paper at {}. ",
                          title_of(sensor.sensor.sensor), last_step(sensor), kPaperSteps);
  if (experiment.world.landmarks != kPaperLandmarks)
    text += fmt::format("{} where the paper had {}. ",
                        counted(experiment.world.landmarks, "landmark"), kPaperLandmarks);
  return text;
}

std::vector<Callout> caveats(const Study& study) {
  std::vector<Callout> found;
  const Experiment& experiment = study.experiment;
  const long planned = static_cast<long>(experiment.layouts) * experiment.poses;
  if (static_cast<long>(study.runs.size()) < planned)
    found.push_back({Callout::Tone::kWarning, "Incomplete",
                     plain(fmt::format("{} of {} are done; every number below rests on these.",
                                       study.runs.size(), counted(planned, "run")))});
  if (const std::string smaller = smaller_than_paper(experiment); !smaller.empty())
    found.push_back({Callout::Tone::kNote, "Not the paper\u2019s protocol",
                     plain(smaller + "The printed values are shown for orientation.")});
  return found;
}

}  // namespace

Section summary_section(const Study& study) {
  Section section{"summary", "Summary", {}};
  section.blocks.emplace_back(plain(fmt::format(
      "Maps of {} built from what a simulated robot observed, without ever estimating its pose. "
      "MPE, mean position error: mean distance to the true position over the landmarks that are "
      "no anchors. MOE, mean orientation error: share of landmark triples that turn the wrong way.",
      counted(study.experiment.world.landmarks, "landmark"))));
  BulletList findings;
  Highlights highlights;
  for (const SensorStudy& sensor : study.experiment.sensors)
    add_sensor(study, sensor, findings, highlights);
  add_ends(study, findings, highlights);
  section.blocks.emplace_back(std::move(highlights));
  for (Callout& callout : caveats(study)) section.blocks.emplace_back(std::move(callout));
  section.blocks.emplace_back(std::move(findings));
  return section;
}

}  // namespace mapproof
