#include "reports/sections/study_report.hpp"

#include "reports/sections/provenance.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "render/figures/status_text.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/certificates.hpp"
#include "reports/sections/findings.hpp"
#include "reports/sections/method_ranks.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/study_counts.hpp"
#include "reports/sections/tables/cells.hpp"
#include "reports/sections/tables/method_tables.hpp"
#include "reports/sections/variation_summary.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

std::string subtitle(const Study& study) {
  const Experiment& experiment = study.experiment;
  return fmt::format("Experiment {}, seed {}: {}, {}, room of {:g} m", experiment.name,
                     experiment.seed, counted(std::ssize(study.runs), "simulated run"),
                     counted(experiment.world.landmarks, "landmark"), experiment.world.side_m);
}

void add_half(const SensorStudy& sensor, const HalfChoices& choices, int decimals,
              Section& section) {
  if (choices.halves == Halves::kNone) {
    section.blocks.emplace_back(
        plain("The parameter cannot be chosen on one half of the runs and judged on the other: "
              "there are no two halves."));
    return;
  }
  if (const std::string words = optimism_words(choices); !words.empty())
    section.blocks.emplace_back(plain(
        "Choosing the parameter by the very runs that are then reported, as the paper does, is "
        "optimistic: " +
        words));
  section.blocks.emplace_back(half_table(sensor, choices, decimals));
}

void add_ranks(const Study& study, const SensorStudy& sensor, int decimals, Section& section) {
  const MethodRanks ranks = method_ranks(study, sensor);
  if (ranks.test) {
    Table table = rank_table(sensor, ranks, decimals);
    if (std::string note = disagreement_of(compare_methods(study, sensor)); !note.empty())
      table.notes.push_back(std::move(note));
    section.blocks.emplace_back(std::move(table));
  } else {
    section.blocks.emplace_back(
        plain(fmt::format("Methods cannot be ranked by a test: {} scored by {} in common; two of "
                          "each are needed.",
                          counted(std::ssize(ranks.layouts), "layout"),
                          counted(std::ssize(ranks.methods), "method"))));
  }
}

constexpr std::size_t kLocationsShown = 5;  ///< With what was found; of the others the id alone.
constexpr std::size_t kLocationsListed = 1000;  ///< Some 60 kB of a page.

/// Sensor and method: what statuses are counted by, over all parameters.
using StatusKind = std::pair<Sensor, Method>;

StatusKind kind_of(const RunRecord& record) { return {record.sensor, record.setting.method}; }

void add_record(StatusList::Item& item, const RunId& run, const RunRecord& record,
                StatusCode code) {
  ++item.count;
  const bool is_short = item.locations.size() >= kLocationsShown;
  for (const Status& status : record.statuses)
    if (status.code == code && item.locations.size() < kLocationsListed)
      item.locations.push_back({record_id(run, record.sensor, record.setting, record.step),
                                is_short ? "" : status_text(status)});
}

/// Severest first: no map, then by share.
bool before(const StatusList::Item& a, const StatusList::Item& b) {
  if (a.failed != b.failed) return a.failed;
  return static_cast<double>(a.count) * b.of > static_cast<double>(b.count) * a.of;
}

StatusList status_list(const Study& study) {
  std::map<StatusKind, int> totals;
  std::map<std::pair<StatusKind, StatusCode>, StatusList::Item> items;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records) {
      ++totals[kind_of(record)];
      for (std::size_t i = 0; i < record.statuses.size(); ++i) {
        const StatusCode code = record.statuses[i].code;
        const auto earlier = std::span(record.statuses).first(i);
        if (std::ranges::any_of(earlier, [&](const Status& s) { return s.code == code; })) continue;
        StatusList::Item& item = items[{kind_of(record), code}];
        item.where = fmt::format("{}, {}", name(record.sensor), info(record.setting.method).label);
        add_record(item, run.id, record, code);
      }
    }
  StatusList list;
  for (auto& [key, item] : items) {
    item.code = name(key.second);
    item.meaning = meaning(key.second);
    item.failed = key.second == StatusCode::kFailed || key.second == StatusCode::kAnchorsMissing;
    item.of = totals[key.first];
    list.items.push_back(std::move(item));
  }
  std::ranges::stable_sort(list.items, before);
  return list;
}

void add_sensor(const Study& study, const SensorStudy& sensor, BulletList& findings) {
  const auto methods = best_of_each_method(summarize(study, sensor, last_step(sensor)));
  if (best_of(methods) == nullptr)
    findings.items.push_back(
        {{strong(title_of(sensor.sensor.sensor)), phrase(": no map could be scored.")}});
  else
    std::ranges::move(sensor_findings(study, sensor, methods).items,
                      std::back_inserter(findings.items));
}

void add_ends(const Study& study, BulletList& findings) {
  const StudyCounts counts = count(study);
  if (counts.maps == 0) return;
  const std::string text = counts.with_status + counts.unscored == 0
                               ? fmt::format("none in {}", counted(counts.maps, "map"))
                               : endings_text(counts) + "; all are listed below";
  findings.items.push_back({{strong("Warnings and failures"), phrase(": " + text + ".")}});
}

std::vector<Callout> caveats(const Study& study) {
  std::vector<Callout> found;
  const Experiment& experiment = study.experiment;
  if (const std::string incomplete = mapping_incomplete(study); !incomplete.empty())
    found.push_back({Callout::Tone::kWarning, "Incomplete", plain(incomplete)});
  if (const std::string smaller = smaller_than_paper(experiment); !smaller.empty())
    found.push_back({Callout::Tone::kNote, "Not the paper\u2019s protocol",
                     plain(smaller + "The printed values are shown for orientation.")});
  return found;
}

}  // namespace

std::string mapping_incomplete(const Study& study) {
  const long planned = static_cast<long>(study.experiment.layouts) * study.experiment.poses;
  return incomplete_text(std::ssize(study.runs), planned, "run");
}

Report study_report(const StudyReportInput& input) {
  const Experiment& experiment = input.study.experiment;
  Report report;
  report.title = experiment.title.empty() ? experiment.name : experiment.title;
  report.subtitle = subtitle(input.study);
  report.sections.push_back(summary_section(input.study));
  for (const SensorStudy& sensor : experiment.sensors)
    report.sections.push_back(accuracy_section(input.study, sensor));
  for (const FigureGroup& group : input.figures.groups)
    report.sections.push_back(figures_section(group));
  if (auto variations = variations_section(input.study))
    report.sections.push_back(*std::move(variations));
  report.sections.push_back(statuses_section(input.study));
  if (auto certificates = certificates_section(input.study))
    report.sections.push_back(*std::move(certificates));
  report.sections.push_back(
      provenance_section(input.study, input.sessions, input.timings, input.command));
  report.opening = study_opening(input.study, input.figures);
  report.date = date_of(input.sessions);
  report.footer = fmt::format("Made by mapproof {} ({}).", input.study.provenance.version,
                              input.study.provenance.commit);
  return report;
}

Section accuracy_section(const Study& study, const SensorStudy& sensor) {
  const std::vector<SettingSummary> all = summarize(study, sensor, last_step(sensor));
  const std::vector<SettingSummary> best = best_of_each_method(all);
  const bool grid = all.size() > best.size();
  const int decimals = mpe_decimals(study);
  Section section;
  section.interest = Interest::kMost;
  section.id = fmt::format("methods-{}", name(sensor.sensor.sensor));
  section.title = title_of(sensor.sensor.sensor) + ": methods";
  section.blocks.emplace_back(plain(fmt::format(
      "Maps after {}, aligned to {} by the affine map of {}. Smaller is better.",
      counted(last_step(sensor), "observation"), counted(study.experiment.anchors, "anchor"),
      label(study.experiment.affine_fit))));
  section.blocks.emplace_back(accuracy_table(sensor, best, grid, decimals));
  const std::size_t main_blocks = section.blocks.size();
  if (!sensor.published.values.empty())
    section.blocks.emplace_back(paper_parameter_table(sensor, all, decimals));
  const std::vector<OrderingClaim> claims = ordering_claims(study, sensor);
  if (std::ranges::any_of(claims,
                          [](const OrderingClaim& one) { return one.difference_m.has_value(); }))
    section.blocks.emplace_back(ordering_table(sensor, claims, decimals));
  if (grid) add_half(sensor, half_choices(study, sensor), decimals, section);
  if (best.size() > 1) add_ranks(study, sensor, decimals, section);
  section.blocks.emplace_back(spread_table(sensor, best, decimals));
  if (grid) section.blocks.emplace_back(parameter_table(sensor, all, decimals));
  for (std::size_t i = main_blocks; i < section.blocks.size(); ++i)
    if (auto* table = std::get_if<Table>(&section.blocks[i])) table->secondary = true;
  return section;
}

Section statuses_section(const Study& study) {
  const StudyCounts counts = count(study);
  Section section;
  section.id = "warnings";
  section.title = "Warnings and failures";
  StatusList list = status_list(study);
  if (list.items.empty() && counts.unscored == 0) {
    section.blocks.emplace_back(
        plain(counts.maps == 0 ? "No map was made."
                               : fmt::format("None in {}.", counted(counts.maps, "map"))));
    return section;
  }
  section.blocks.emplace_back(plain(fmt::format(
      "{}. The numbers above include every map that could be scored, with or without warnings.",
      capitalised(endings_text(counts)))));
  section.blocks.emplace_back(std::move(list));
  return section;
}

Section summary_section(const Study& study) {
  Section section{"summary", "Summary", {}};
  section.blocks.emplace_back(plain(fmt::format(
      "Maps of {} built from what a simulated robot observed, without ever estimating its pose. "
      "MPE, mean position error: mean distance to the true position over the landmarks that are "
      "not anchors. MOE, mean orientation error: share of landmark triples with the wrong "
      "orientation.",
      counted(study.experiment.world.landmarks, "landmark"))));
  BulletList findings;
  for (const SensorStudy& sensor : study.experiment.sensors) add_sensor(study, sensor, findings);
  add_ends(study, findings);
  for (Callout& callout : caveats(study)) section.blocks.emplace_back(std::move(callout));
  section.blocks.emplace_back(std::move(findings));
  return section;
}

Section figures_section(const FigureGroup& group) {
  Section section{group.id, group.title, {}};
  section.interest = group.interest;
  section.blocks.emplace_back(plain(group.words));
  section.blocks.emplace_back(gallery_of(group));
  return section;
}

std::optional<Section> variations_section(const Study& study) {
  if (study.experiment.variations.empty()) return std::nullopt;
  Section section{"variations", "Variations", {}, "", Interest::kFew};
  section.blocks.emplace_back(
      plain("The numbers behind the figures of anchors, noise and missing entries, one thing "
            "changed at a time."));
  for (const Variation& variation : study.experiment.variations)
    fold(variation_table(study, variation), section);
  return section;
}

}  // namespace mapproof
