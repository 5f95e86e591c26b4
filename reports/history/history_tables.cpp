#include "reports/history/history_tables.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

#include <fmt/format.h>

#include "reports/history/shown_names.hpp"

namespace mapproof {
namespace {

TextCell text(std::string words) { return {std::move(words), Emphasis::kPlain}; }

Cell number(double value, int decimals) {
  if (!std::isfinite(value)) return MissingCell{};
  return NumberCell{value, decimals};
}

std::string words_of(const NightFacts& night) {
  switch (night.verdict) {
    case NightVerdict::kGood:
      return std::string(verdict_word(night));
    case NightVerdict::kCost:
      return "slower or larger";
    default:
      return "accuracy worse";
  }
}

/// The last step of each method, of what is an error or shown.
std::vector<SeriesId> last_steps(const StudyTrend& trend) {
  std::vector<SeriesId> last;
  for (const auto& [id, values] : trend.medians) {
    const NightlyRule rule = rule_of(id, trend.quantities, trend.medians);
    if (!is_accuracy(rule) && rule != NightlyRule::kShown) continue;
    const auto later = std::ranges::find_if(last, [&](const SeriesId& other) {
      return method_of(other) == method_of(id) && other.quantity == id.quantity;
    });
    if (later == last.end())
      last.push_back(id);
    else
      *later = id;
  }
  return last;
}

}  // namespace

std::string to_the_minute(const std::string& utc) {
  if (utc.size() != 20 || utc[10] != 'T' || utc[19] != 'Z') return utc;
  return utc.substr(0, 10) + " " + utc.substr(11, 5);
}

Table nights_table(std::span<const NightFacts> nights, const NightFindings& findings,
                   const NightStudies& studies, NightLinks& links) {
  Table table{.id = "nights",
              .caption = "Every night, the last one first.",
              .columns = {{"Night", "", "", "Its number: the order of nights, whatever clocks say"},
                          {"Started", "", "", "UTC"},
                          {"Verdict", "", "", ""},
                          {"Findings", "", "", "How many"},
                          {"Against", "", "", "The night it was compared with"},
                          {"Host", "", "", ""},
                          {"Report", "", "", "Of that night; the folder of several"}},
              .rows = {},
              .notes = {}};
  for (const NightFacts& night : nights | std::views::reverse) {
    const auto found = findings.find(night.number);
    const std::size_t count = found == findings.end() ? 0 : found->second.size();
    const auto made = studies.find(night.number);
    const Phrase place = made != studies.end() && made->second.size() == 1
                             ? links.report(night.number, made->second.front())
                             : links.folder(night.number);
    // What got worse is not to be told by its words alone.
    const Emphasis weight =
        night.verdict == NightVerdict::kGood ? Emphasis::kPlain : Emphasis::kStrong;
    const Cell against = night.reference ? Cell{number(*night.reference, 0)} : Cell{MissingCell{}};
    table.rows.push_back(
        {{number(night.number, 0), text(to_the_minute(night.started_utc)),
          TextCell{words_of(night) + (night.pinned ? ", pinned" : ""), weight},
          number(static_cast<double>(count), 0), against, TextCell{night.host, Emphasis::kData},
          TextCell{place.text, place.emphasis}},
         fmt::format("night {}", night.number)});
  }
  return table;
}

Table findings_table(const NightFindings& findings, const std::string& study) {
  Table table{.id = "findings",
              .caption = "What got worse, the last night first.",
              .columns = {{"Night", "", "", ""},
                          {"Since", "", "", "The night it began, as far as can be told"},
                          {"Kind", "", "", "By which rule"},
                          {"Finding", "", "", ""}},
              .rows = {},
              .notes = {}};
  for (const auto& [night, of_night] : findings | std::views::reverse)
    for (const NightFinding& finding : of_night)
      if (finding.study == study)
        table.rows.push_back({{number(night, 0), number(finding.since, 0),
                               text(std::string(name(finding.rule))), text(finding.sentence)},
                              fmt::format("night {}", night)});
  return table;
}

Table accuracy_table(const StudyTrend& trend) {
  const std::vector<SeriesId> shown = last_steps(trend);
  const bool has_steps = std::ranges::any_of(shown, [](const SeriesId& id) { return id.step > 0; });
  Table table{.id = "accuracy-now",
              .caption = has_steps ? "Medians over the runs at the last step of each method."
                                   : "Medians over the runs.",
              .columns = {{"Method", "", "", ""},
                          {"Quantity", "", "", ""},
                          {"Unit", "", "", ""},
                          {"First", "", "", "The first of the nights shown"},
                          {"Before", "", "", "The night before the last"},
                          {"Last", "", "", "The last night"}},
              .rows = {},
              .notes = {}};
  for (const SeriesId& id : shown) {
    const Quantity& quantity = trend.quantities.at(id.quantity);
    const std::vector<double>& values = trend.medians.at(id);
    const double before = values.size() > 1 ? values[values.size() - 2] : std::nan("");
    table.rows.push_back(
        {{text(shown_subject(trend.labels, id)), text(quantity.label), text(quantity.unit),
          number(values.front(), 4), number(before, 4), number(values.back(), 4)},
         "medians over runs"});
  }
  return table;
}

}  // namespace mapproof
