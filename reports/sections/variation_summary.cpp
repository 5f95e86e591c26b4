#include "reports/sections/variation_summary.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "reports/sections/run_scores.hpp"
#include "reports/sections/tables/cells.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

/// What a reader calls a quantity, and how its levels are shown.
struct Shown {
  std::string words;
  double factor = 1.0;
};

Shown shown(const Variation& variation) {
  switch (variation.factor) {
    case Factor::kNoise:
      if (variation.sensor == Sensor::kVisibility) return {"wrong visibility entries [%]", 100.0};
      if (variation.sensor == Sensor::kBearing)
        return {"bearing noise [\u00B0]", 180.0 / std::numbers::pi};
      return {"range noise [m]"};
    case Factor::kDropoutShare:
      return {"missing entries [%]", 100.0};
    case Factor::kAnchors:
      return {"number of anchors"};
    case Factor::kSmacofFall:
    case Factor::kSmacofKnnFall:
      return {"relative fall of the stress at which SMACOF stops"};
    case Factor::kOnlySeenTogether:
      return {"neighbours (0: any pair, 1: only covisible pairs)"};
    case Factor::kSide:
    case Factor::kLandmarks:
    case Factor::kDiameter:
    case Factor::kReach:
    case Factor::kSteps:
      break;  // Of sweeps alone.
  }
  return {};
}

/// "SDE, K = 7: uncertified in 11 of 25 runs at 10, in 25 of 25 at 20.", one sentence per status.
std::vector<std::string> status_notes(const Variation& variation, const VariedSetting& setting) {
  std::map<StatusCode, std::string> places;
  for (std::size_t level = 0; level < variation.levels.size(); ++level)
    for (const auto& [code, count] : setting.statuses[level])
      places[code] +=
          fmt::format("{}in {} of {} at {:.6g}", places[code].empty() ? "" : ", ", count,
                      setting.runs[level], shown_level(variation, variation.levels[level]));
  std::vector<std::string> notes;
  for (const auto& [code, where] : places)
    notes.push_back(fmt::format("{}: {} {}.", label(setting.setting), name(code), where));
  return notes;
}

}  // namespace

std::vector<VariedSetting> summarize(const Study& study, const Variation& variation) {
  const std::size_t levels = variation.levels.size();
  std::vector<VariedSetting> settings;
  for (const MethodSetting& setting : variation.settings)
    settings.push_back({.setting = setting,
                        .runs = std::vector<int>(levels),
                        .scored = std::vector<int>(levels),
                        .statuses = std::vector<std::map<StatusCode, int>>(levels),
                        .mpe_m = {},
                        .moe_percent = {}});
  std::vector<std::vector<RunValues>> mpe(settings.size(), std::vector<RunValues>(levels));
  auto moe = mpe;
  for (const Run& run : study.runs)
    for (const VariationRecord& record : run.variations) {
      if (record.variation != variation.id) continue;
      const auto at = std::ranges::find(variation.levels, record.level);
      const auto of = std::ranges::find(variation.settings, record.setting);
      if (at == variation.levels.end() || of == variation.settings.end()) continue;
      const auto i = static_cast<std::size_t>(of - variation.settings.begin());
      const auto level = static_cast<std::size_t>(at - variation.levels.begin());
      ++settings[i].runs[level];
      std::set<StatusCode> codes;
      for (const Status& status : record.statuses) codes.insert(status.code);
      for (const StatusCode code : codes) ++settings[i].statuses[level][code];
      if (!record.score || !usable(*record.score)) continue;
      ++settings[i].scored[level];
      mpe[i][level].add(run.id, record.score->mpe_m);
      moe[i][level].add(run.id, record.score->moe_percent);
    }
  for (std::size_t i = 0; i < settings.size(); ++i)
    for (std::size_t level = 0; level < levels; ++level) {
      settings[i].mpe_m.push_back(mpe[i][level].mean());
      settings[i].moe_percent.push_back(moe[i][level].mean());
    }
  return settings;
}

double shown_level(const Variation& variation, double level) {
  return level * shown(variation).factor;
}

std::string level_words(const Variation& variation) { return shown(variation).words; }

Table variation_table(const Study& study, const Variation& variation) {
  const std::vector<VariedSetting> settings = summarize(study, variation);
  Table table;
  table.id = "variation-" + variation.id;
  table.caption = fmt::format("{}: MPE [m] after {} observations, by {}",
                              title_of(variation.sensor), variation.step, level_words(variation));
  if (variation.placement)
    table.caption += fmt::format("; anchors placed by {}", name(*variation.placement));
  table.columns.push_back({"Method", "", "", ""});
  table.columns.push_back({"Parameter", "", "", ""});
  for (const double level : variation.levels)
    table.columns.push_back(
        {fmt::format("{:.6g}", shown_level(variation, level)), "", level_words(variation), ""});
  for (const VariedSetting& setting : settings) {
    Row row{{method_cell(setting.setting.method), parameter_cell(setting.setting)}, "", false};
    for (const auto& estimate : setting.mpe_m) row.cells.push_back(mean_cell(estimate, 3));
    table.rows.push_back(std::move(row));
  }
  table.notes.push_back("Mean over the runs that could be scored.");
  for (std::size_t i = 0; i < settings.size(); ++i)
    for (std::size_t level = 0; level < variation.levels.size(); ++level)
      if (settings[i].scored[level] < settings[i].runs[level])
        table.notes.push_back(fmt::format("{} at {:.6g}: {} of {} runs scored.",
                                          label(settings[i].setting),
                                          shown_level(variation, variation.levels[level]),
                                          settings[i].scored[level], settings[i].runs[level]));
  for (const VariedSetting& setting : settings)
    for (std::string& note : status_notes(variation, setting))
      table.notes.push_back(std::move(note));
  return table;
}

}  // namespace mapproof
