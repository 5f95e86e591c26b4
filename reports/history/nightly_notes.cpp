#include "reports/history/nightly_notes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "reports/history/regression_rules.hpp"

namespace mapproof {
namespace {

constexpr std::array kKindNames = {std::pair(NoteKind::kNote, "note"),
                                   std::pair(NoteKind::kKnown, "known"),
                                   std::pair(NoteKind::kAccepted, "accepted")};

/// By how much a known finding has to get worse to be new again, in the unit of its change: by what
/// its rule would take for a change.
double least_worsening(HistoryRule rule) {
  const RegressionRules rules;
  switch (rule) {
    case HistoryRule::kSeconds:
    case HistoryRule::kAllSeconds:
    case HistoryRule::kCostDrift:
      return 100.0 * rules.least_slowdown;
    case HistoryRule::kMemory:
      return 100.0 * rules.least_growth;
    default:
      return 100.0 * rules.least_ratio;
  }
}

bool is_positive_number(std::string_view text, int& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number > 0;
}

}  // namespace

std::string_view name(NoteKind kind) { return kKindNames.at(static_cast<std::size_t>(kind)).second; }

std::optional<NoteKind> note_kind_named(std::string_view name) {
  for (const auto& [kind, known] : kKindNames)
    if (name == known) return kind;
  return std::nullopt;
}

void put_finding(NightlyNote& note, const NightlyFinding& finding) {
  note.study = finding.study;
  note.subject = finding.subject;
  note.quantity = finding.quantity;
  note.since = finding.since;
  note.change = finding.change;
}

NightlyNote parse_note_target(const std::string& text, std::string_view option) {
  NightlyNote note;
  const std::size_t dot = text.find('.');
  const std::string_view all = text;
  const bool is_one = is_positive_number(all.substr(0, dot), note.nightly_run) &&
                      (dot == std::string::npos ||
                       is_positive_number(all.substr(dot + 1), note.finding));
  if (!is_one)
    throw InvalidInput(fmt::format("{}: \"{}\" is not a nightly run, \"7\", and not one of its "
                                   "findings, \"7.2\"",
                                   option, printable(text)));
  return note;
}

std::vector<NightlyNote> by_finding(const NightlyNote& note,
                                    std::span<const NightlyFinding> findings) {
  if (note.kind != NoteKind::kKnown || note.finding > 0) return {note};
  std::vector<NightlyNote> notes;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    notes.push_back(note);
    notes.back().finding = static_cast<int>(i) + 1;
  }
  return notes;
}

const NightlyNote* known_by(std::span<const NightlyNote> notes, const NightlyFinding& finding) {
  const auto found = std::ranges::find_if(notes, [&](const NightlyNote& note) {
    if (note.kind != NoteKind::kKnown || note.study != finding.study ||
        note.subject != finding.subject || note.quantity != finding.quantity ||
        note.since != finding.since)
      return false;
    if (!note.change || !finding.change) return note.change == finding.change;
    return std::abs(*finding.change) < std::abs(*note.change) + least_worsening(finding.rule);
  });
  return found == notes.end() ? nullptr : &*found;
}

std::vector<NightlyFinding> new_findings(std::span<const NightlyFinding> findings,
                                         std::span<const NightlyNote> notes) {
  std::vector<NightlyFinding> unknown;
  std::ranges::copy_if(
      findings, std::back_inserter(unknown),
      [&](const NightlyFinding& finding) { return known_by(notes, finding) == nullptr; });
  return unknown;
}

std::vector<NightlyNote> notes_on(int nightly_run, std::span<const NightlyNote> notes) {
  std::vector<NightlyNote> on;
  std::ranges::copy_if(notes, std::back_inserter(on), [&](const NightlyNote& note) {
    return note.nightly_run == nightly_run;
  });
  return on;
}

}  // namespace mapproof
