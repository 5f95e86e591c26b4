#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/model/format.hpp"
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

Phrase words(std::string text) { return {std::move(text), Emphasis::kPlain}; }
Phrase strong(std::string text) { return {std::move(text), Emphasis::kStrong}; }

std::string metres(double value) { return format_number(value, value < 0.1 ? 4 : 3) + " m"; }

std::string percent(double value) { return format_number(value, 2) + " %"; }

bool has_published(const SensorStudy& sensor) { return !sensor.published.empty(); }

std::string with_interval(const MeanEstimate& mpe) {
  const auto interval = interval_of(mpe);
  if (!interval) return metres(mpe.mean);
  const int decimals = mpe.mean < 0.1 ? 4 : 3;
  return fmt::format("{} (95 % interval {} to {} m)", metres(mpe.mean),
                     format_number(interval->low, decimals),
                     format_number(interval->high, decimals));
}

const PublishedValue* best_published(const SensorStudy& sensor) {
  const auto best = std::ranges::min_element(sensor.published, {}, &PublishedValue::mpe_m);
  return best == sensor.published.end() ? nullptr : &*best;
}

std::string relative(double ours, double paper) {
  return format_number(100.0 * (ours - paper) / paper, 0, true) + " %";
}

/// "Bearing: SMACOF, kNN weights, K = 7 is best, …"
Paragraph best_finding(const SensorStudy& sensor, const SettingSummary& best) {
  Paragraph text;
  text.phrases.push_back(strong(title_of(best.sensor)));
  text.phrases.push_back(words(fmt::format(": after {} observations ", best.step)));
  text.phrases.push_back(strong(label(best.setting)));
  text.phrases.push_back(words(fmt::format(
      " is the most accurate of {}: MPE {}, MOE {}.", counted(std::ssize(sensor.methods), "method"),
      with_interval(*best.mpe_m), percent(best.moe_percent->mean))));
  if (best.published)
    text.phrases.push_back(
        words(fmt::format(" The paper printed {} and {} for this method: ours differs by {}.",
                          metres(best.published->mpe_m), percent(best.published->moe_percent),
                          relative(best.mpe_m->mean, best.published->mpe_m))));
  const PublishedValue* paper_best = best_published(sensor);
  if (paper_best != nullptr && paper_best->setting.method != best.setting.method)
    text.phrases.push_back(
        words(fmt::format(" The paper\u2019s best of these methods is {}, {}.",
                          label(paper_best->setting), metres(paper_best->mpe_m))));
  return text;
}

/// Methods from best to worst, and whether the paper has the same order.
Paragraph order_finding(const SensorStudy& sensor, std::vector<SettingSummary> methods) {
  std::erase_if(methods, [](const SettingSummary& s) { return !s.mpe_m; });
  std::ranges::stable_sort(methods, {}, [](const SettingSummary& s) { return s.mpe_m->mean; });
  std::string order;
  for (const SettingSummary& s : methods)
    order += fmt::format("{}{} ({})", order.empty() ? "" : " < ", info(s.setting.method).label,
                         metres(s.mpe_m->mean));
  Paragraph text{{strong(title_of(sensor.sensor.sensor)), words(", by MPE: " + order + ".")}};
  std::erase_if(methods, [](const SettingSummary& s) { return !s.published; });
  if (methods.size() < 2) return text;
  const bool same = std::ranges::is_sorted(
      methods, {}, [](const SettingSummary& s) { return s.published->mpe_m; });
  if (same) {
    text.phrases.push_back(words(" The paper has the same order."));
    return text;
  }
  std::ranges::stable_sort(methods, {}, [](const SettingSummary& s) { return s.published->mpe_m; });
  std::string paper_order;
  for (const SettingSummary& s : methods)
    paper_order +=
        fmt::format("{}{}", paper_order.empty() ? "" : " < ", info(s.setting.method).label);
  text.phrases.push_back(words(" The paper\u2019s order: " + paper_order + "."));
  return text;
}

/// How many published values lie within our intervals.
Paragraph agreement_finding(const SensorStudy& sensor, std::span<const SettingSummary> methods) {
  int compared = 0;
  int within = 0;
  const SettingSummary* farthest = nullptr;
  const auto gap = [](const SettingSummary& s) {
    return std::abs(mpe_difference_m(s) / s.published->mpe_m);
  };
  for (const SettingSummary& s : methods) {
    if (!s.published || !s.mpe_m) continue;
    if (farthest == nullptr || gap(s) > gap(*farthest)) farthest = &s;
    const auto interval = interval_of(s.mpe_m);
    if (!interval) continue;
    ++compared;
    if (s.published->mpe_m >= interval->low && s.published->mpe_m <= interval->high) ++within;
  }
  Paragraph text{{strong(title_of(sensor.sensor.sensor)), words(", beside the paper: ")}};
  if (compared > 0)
    text.phrases.push_back(words(
        fmt::format("{} of {} printed MPE lie within our 95 % intervals; ", within, compared)));
  if (farthest != nullptr)
    text.phrases.push_back(words(fmt::format(
        "the largest difference is {} for {} ({}, printed {}).",
        relative(farthest->mpe_m->mean, farthest->published->mpe_m), label(farthest->setting),
        metres(farthest->mpe_m->mean), metres(farthest->published->mpe_m))));
  return text;
}

void add_sensor(const Study& study, const SensorStudy& sensor, BulletList& findings,
                Highlights& highlights) {
  const auto methods = best_of_each_method(summarize(study, sensor, last_step(sensor)));
  const SettingSummary* best = best_of(methods);
  const std::string title = title_of(sensor.sensor.sensor);
  if (best == nullptr) {
    findings.items.push_back({{strong(title), words(": no map could be scored.")}});
    highlights.items.push_back({title + ", best MPE", kMissingText, "no map could be scored"});
    return;
  }
  findings.items.push_back(best_finding(sensor, *best));
  if (methods.size() > 1) findings.items.push_back(order_finding(sensor, methods));
  if (has_published(sensor) &&
      std::ranges::any_of(methods, [](const SettingSummary& s) { return s.published && s.mpe_m; }))
    findings.items.push_back(agreement_finding(sensor, methods));
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
  findings.items.push_back({{strong("Failures"), words(text)}});
}

/// In what the study is smaller than the paper's; empty if in nothing.
std::string smaller_than_paper(const Experiment& experiment) {
  const bool yairi = std::ranges::any_of(experiment.sensors, [](const SensorStudy& sensor) {
    return sensor.published_source.starts_with("Yairi 2007");
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
