#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr int kMoeDecimals = 2;

Cell number(double value, int decimals, bool with_sign = false) {
  return NumberCell{value, decimals, with_sign};
}

Cell method_cell(const SettingSummary& summary) {
  return TextCell{std::string(info(summary.setting.method).label)};
}

Cell mean_cell(const std::optional<MeanEstimate>& estimate, int decimals) {
  if (!estimate) return MissingCell{};
  return number(estimate->mean, decimals);
}

Cell interval_cell(const std::optional<MeanEstimate>& estimate, int decimals) {
  const auto interval = interval_of(estimate);
  if (!interval) return MissingCell{};
  return IntervalCell{interval->low, interval->high, decimals};
}

Cell parameter_cell(const MethodSetting& setting) {
  const std::string text = parameter_text(setting);
  if (text.empty()) return MissingCell{};
  return TextCell{text};
}

/// Small errors need a place more.
int mpe_decimals(std::span<const SettingSummary> summaries) {
  const bool small = std::ranges::any_of(summaries, [](const SettingSummary& summary) {
    return (summary.mpe_m && summary.mpe_m->mean < 0.1) ||
           (summary.published && summary.published->mpe_m < 0.1);
  });
  return small ? 4 : 3;
}

bool any_published(std::span<const SettingSummary> summaries) {
  return std::ranges::any_of(summaries, [](const auto& s) { return s.published.has_value(); });
}

bool any_interval(std::span<const SettingSummary> summaries) {
  return std::ranges::any_of(summaries,
                             [](const auto& s) { return interval_of(s.mpe_m).has_value(); });
}

std::vector<Column> accuracy_columns(bool published) {
  const std::string mpe = "Mean position error (MPE)";
  const std::string moe = "Mean orientation error (MOE)";
  const std::string interval = "Of the mean; layouts are the units.";
  std::vector<Column> columns = {
      {"Method", "", "", ""},
      {"Parameter", "", "", "The one of least mean MPE among those tried."}};
  if (published) columns.push_back({"Paper\u2019s", "", "", "The one that the paper found best."});
  columns.push_back({"Mean", "m", mpe, "Over runs."});
  columns.push_back({"95 % interval", "m", mpe, interval});
  if (published) {
    columns.push_back({"Paper", "m", mpe, "As printed."});
    columns.push_back({"Difference", "m", mpe, "Ours less the paper\u2019s."});
    columns.push_back({"Difference", "%", mpe, "Of the paper\u2019s value."});
  }
  columns.push_back({"Mean", "%", moe, "Over runs."});
  columns.push_back({"95 % interval", "%", moe, interval});
  if (published) {
    columns.push_back({"Paper", "%", moe, "As printed."});
    columns.push_back({"Difference", "points", moe, "Ours less the paper\u2019s."});
  }
  return columns;
}

std::vector<Cell> accuracy_cells(const SettingSummary& s, bool published, int decimals) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const double paper_mpe = s.published ? s.published->mpe_m : kNan;
  const double difference = mpe_difference_m(s);
  std::vector<Cell> cells = {method_cell(s), parameter_cell(s.setting)};
  if (published)
    cells.push_back(s.published ? parameter_cell(s.published->setting) : Cell{MissingCell{}});
  cells.push_back(mean_cell(s.mpe_m, decimals));
  cells.push_back(interval_cell(s.mpe_m, decimals));
  if (published) {
    cells.push_back(number(paper_mpe, decimals));
    cells.push_back(number(difference, decimals, true));
    cells.push_back(number(100.0 * difference / paper_mpe, 1, true));
  }
  cells.push_back(mean_cell(s.moe_percent, kMoeDecimals));
  cells.push_back(interval_cell(s.moe_percent, kMoeDecimals));
  if (published) {
    cells.push_back(number(s.published ? s.published->moe_percent : kNan, kMoeDecimals));
    cells.push_back(number(moe_difference_percent(s), kMoeDecimals, true));
  }
  return cells;
}

void mark_best(Table& table, std::span<const SettingSummary> summaries) {
  const SettingSummary* best = best_of(summaries);
  if (best != nullptr && summaries.size() > 1)
    table.rows[static_cast<std::size_t>(best - summaries.data())].marked = true;
}

std::string interval_note(std::span<const SettingSummary> summaries) {
  if (any_interval(summaries))
    return "95 % intervals are Student\u2019s t over layouts, since runs in one layout are not "
           "independent; they are cut at 0.";
  return "All runs share one layout: no interval can be given.";
}

Table accuracy_table(const SensorStudy& sensor, std::span<const SettingSummary> best, bool grid) {
  const bool published = any_published(best);
  Table table;
  table.id = fmt::format("accuracy-{}", name(sensor.sensor.sensor));
  table.caption = fmt::format("{}: errors after {} observations", title_of(sensor.sensor.sensor),
                              last_step(sensor));
  table.columns = accuracy_columns(published);
  const int decimals = mpe_decimals(best);
  for (const SettingSummary& summary : best)
    table.rows.push_back({accuracy_cells(summary, published, decimals), source_of(summary), false});
  mark_best(table, best);
  if (grid)
    table.notes.push_back(
        "Each method stands with the parameter of least mean MPE over these very "
        "runs, as the paper chose its own.");
  table.notes.push_back(interval_note(best));
  if (published) table.notes.push_back("Paper: " + sensor.published_source + ".");
  return table;
}

/// What the means hide: medians, the anchors' share in the error, runs that went other than well.
Table spread_table(const SensorStudy& sensor, std::span<const SettingSummary> best) {
  const std::string free = "Free of the choice of anchors";
  Table table;
  table.id = fmt::format("behind-{}", name(sensor.sensor.sensor));
  table.caption = title_of(sensor.sensor.sensor) + ": behind the means";
  table.columns = {{"Method", "", "", ""},
                   {"Parameter", "", "", ""},
                   {"Median MPE", "m", "", "Over runs."},
                   {"MPE", "m", free, "The affine map is fitted to all landmarks."},
                   {"MOE", "%", free, "The smaller of MOE and 100 % less MOE."},
                   {"All", "", "Runs", ""},
                   {"Scored", "", "Runs", "Their map could be scored."},
                   {"With status", "", "Runs", "Something went other than well."}};
  const int decimals = mpe_decimals(best);
  for (const SettingSummary& s : best)
    table.rows.push_back(
        {{method_cell(s), parameter_cell(s.setting), number(s.mpe_median_m, decimals),
          number(s.mpe_all_fitted_m, decimals), number(s.moe_unmirrored_percent, kMoeDecimals),
          number(s.runs, 0), number(s.scored, 0), number(s.with_status, 0)},
         source_of(s),
         false});
  table.notes.push_back(
      "MPE hangs on which landmarks are anchors. Free of that: MPE over all landmarks with the "
      "affine map fitted to all of them, and MOE with mirrored maps turned back.");
  return table;
}

Table parameter_table(const SensorStudy& sensor, std::span<const SettingSummary> all) {
  Table table;
  table.id = fmt::format("parameters-{}", name(sensor.sensor.sensor));
  table.caption = title_of(sensor.sensor.sensor) + ": every parameter tried";
  table.columns = {{"Method", "", "", ""},
                   {"Parameter", "", "", ""},
                   {"MPE", "m", "", "Mean over runs."},
                   {"95 % interval", "m", "", ""},
                   {"MOE", "%", "", "Mean over runs."},
                   {"Scored", "", "", ""},
                   {"With status", "", "", ""}};
  const int decimals = mpe_decimals(all);
  for (const SettingSummary& s : all)
    table.rows.push_back({{method_cell(s), parameter_cell(s.setting), mean_cell(s.mpe_m, decimals),
                           interval_cell(s.mpe_m, decimals), mean_cell(s.moe_percent, kMoeDecimals),
                           number(s.scored, 0), number(s.with_status, 0)},
                          source_of(s),
                          false});
  mark_best(table, all);
  return table;
}

}  // namespace

Section accuracy_section(const Study& study, const SensorStudy& sensor) {
  const std::vector<SettingSummary> all = summarize(study, sensor, last_step(sensor));
  const std::vector<SettingSummary> best = best_of_each_method(all);
  const bool grid = all.size() > best.size();
  Section section;
  section.id = fmt::format("methods-{}", name(sensor.sensor.sensor));
  section.title = title_of(sensor.sensor.sensor) + ": methods";
  section.blocks.emplace_back(plain(fmt::format(
      "Maps after {} observations, aligned to {} by the affine map of {}. Smaller is better.",
      last_step(sensor), counted(study.experiment.anchors, "anchor"),
      label(study.experiment.affine_fit))));
  section.blocks.emplace_back(accuracy_table(sensor, best, grid));
  section.blocks.emplace_back(spread_table(sensor, best));
  if (grid) section.blocks.emplace_back(parameter_table(sensor, all));
  return section;
}

}  // namespace mapproof
