#include "reports/sections/variation_summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
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
      return {"pairs that may be neighbours"};
    case Factor::kSide:
    case Factor::kLandmarks:
    case Factor::kDiameter:
    case Factor::kReach:
    case Factor::kSteps:
      break;  // Of sweeps alone.
  }
  return {};
}

/// "at", or "with" of a choice.
std::string_view at_word(const Variation& variation) {
  return variation.factor == Factor::kOnlySeenTogether ? "with" : "at";
}

/// A level as a number; none of a choice.
std::optional<double> number_of(const Variation& variation, double level) {
  if (variation.factor == Factor::kOnlySeenTogether) return std::nullopt;
  return shown_level(variation, level);
}

/// "in 4 of 25 runs at 10 and 20, 11 at 40": levels of the same count together.
std::string places_of(const Variation& variation, const VariedSetting& setting, StatusCode code) {
  struct Place {
    int count, runs;
    std::vector<std::string> levels;
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < variation.levels.size(); ++i) {
    const auto found = setting.statuses[i].find(code);
    if (found == setting.statuses[i].end()) continue;
    const int count = found->second, runs = setting.runs[i];
    auto place = std::ranges::find_if(
        places, [&](const Place& p) { return p.count == count && p.runs == runs; });
    if (place == places.end()) place = places.insert(places.end(), {count, runs, {}});
    place->levels.push_back(level_text(variation, variation.levels[i]));
  }
  std::vector<std::string> words;
  int runs = 0;  // Of the place before.
  for (const Place& place : places) {
    const std::string of =
        place.runs == runs ? "" : fmt::format(" of {}", counted(place.runs, "run"));
    runs = place.runs;
    words.push_back(fmt::format("{}{} {} {}", place.count, of, at_word(variation),
                                listed(place.levels, place.levels.size())));
  }
  return fmt::format("in {}", fmt::join(words, ", "));
}

/// "LLE, K = 8; HLLE, K = 8: arbitrary neighbours in 4 of 25 runs at 10 and 20.": one sentence per
/// status and places, which settings may share.
std::vector<std::string> status_notes(const Variation& variation,
                                      std::span<const VariedSetting> settings) {
  std::vector<std::pair<std::string, std::vector<std::string>>> found;  // With the labels.
  for (const VariedSetting& setting : settings) {
    std::set<StatusCode> codes;
    for (const auto& of_level : setting.statuses)
      for (const auto& [code, count] : of_level) codes.insert(code);
    for (const StatusCode code : codes) {
      const std::string what = words_of(code) + " " + places_of(variation, setting, code);
      auto at = std::ranges::find(found, what, [](const auto& note) { return note.first; });
      if (at == found.end()) at = found.insert(found.end(), {what, {}});
      at->second.push_back(label(setting.setting));
    }
  }
  std::vector<std::string> notes;
  for (const auto& [what, labels] : found)
    notes.push_back(fmt::format("{}: {}.", fmt::join(labels, "; "), what));
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
                        .moe_percent = {},
                        .mpe_by_run = std::vector<RunValues>(levels)});
  std::vector<std::vector<RunValues>> moe(settings.size(), std::vector<RunValues>(levels));
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
      settings[i].mpe_by_run[level].add(run.id, record.score->mpe_m);
      moe[i][level].add(run.id, record.score->moe_percent);
    }
  for (std::size_t i = 0; i < settings.size(); ++i)
    for (std::size_t level = 0; level < levels; ++level) {
      settings[i].mpe_m.push_back(settings[i].mpe_by_run[level].mean());
      settings[i].moe_percent.push_back(moe[i][level].mean());
    }
  return settings;
}

bool all_overlap(const std::vector<std::optional<MeanEstimate>>& means) {
  double low = -HUGE_VAL, high = HUGE_VAL;
  for (const auto& mean : means) {
    const std::optional<Interval> interval = interval_of(mean);
    if (!interval) return false;
    low = std::max(low, interval->low);
    high = std::min(high, interval->high);
  }
  return means.size() > 1 && low <= high;
}

double shown_level(const Variation& variation, double level) {
  return level * shown(variation).factor;
}

std::string level_text(const Variation& variation, double level) {
  if (variation.factor != Factor::kOnlySeenTogether)
    return level_number_text(shown_level(variation, level));
  return level > 0.0 ? "covisible pairs only" : "any pair";
}

std::string level_words(const Variation& variation) { return shown(variation).words; }

Table variation_table(const Study& study, const Variation& variation) {
  const std::vector<VariedSetting> settings = summarize(study, variation);
  const int decimals = mpe_decimals(study);
  Table table;
  table.id = "variation-" + variation.id;
  table.caption = fmt::format("{}: MPE [m] after {}, by {}", title_of(variation.sensor),
                              counted(variation.step, "observation"), level_words(variation));
  if (variation.placement)
    table.caption += fmt::format("; anchors placed by {}", name(*variation.placement));
  table.columns.push_back({"Method", "", "", ""});
  table.columns.push_back({"Parameter", "", "", ""});
  for (const double level : variation.levels)
    table.columns.push_back({level_text(variation, level), "", level_words(variation), "",
                             std::nullopt, number_of(variation, level)});
  for (const VariedSetting& setting : settings) {
    Row row{{method_cell(setting.setting.method), parameter_cell(setting.setting)}, "", false};
    for (const auto& estimate : setting.mpe_m) row.cells.push_back(mean_cell(estimate, decimals));
    table.rows.push_back(std::move(row));
  }
  table.notes.push_back("Mean over the runs that could be scored.");
  if (settings.size() == 1 && all_overlap(settings.front().mpe_m))
    table.notes.push_back("The 95 % intervals of all means overlap: no figure shows them.");
  for (std::size_t i = 0; i < settings.size(); ++i)
    for (std::size_t level = 0; level < variation.levels.size(); ++level)
      if (settings[i].scored[level] < settings[i].runs[level])
        table.notes.push_back(fmt::format("{} {} {}: {} of {} runs scored.",
                                          label(settings[i].setting), at_word(variation),
                                          level_text(variation, variation.levels[level]),
                                          settings[i].scored[level], settings[i].runs[level]));
  for (std::string& note : status_notes(variation, settings))
    table.notes.push_back(std::move(note));
  return table;
}

}  // namespace mapproof
