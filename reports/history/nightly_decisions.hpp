#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/json/fields.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/nightly_notes.hpp"

namespace mapproof {

/// What a person decided on one page of a history.
struct NightlyDecision {
  std::string target = {};  ///< "7.2": finding 2 of nightly run 7; "7": the nightly run.
  NoteKind decision = NoteKind::kNote;
  std::string text = {};
};

/// mapproof-decisions.json, which the index of a history saves.
struct NightlyDecisions {
  std::vector<NightlyDecision> decisions = {};
};

template <typename Visitor>
void fields(Visitor& v, NightlyDecision& decision) {
  v.type("decision");
  v.field("target", decision.target,
          {.description = "A nightly run, \"7\", or one of its findings, \"7.2\".",
           .max_bytes = 30});
  v.field("decision", decision.decision);
  v.field("text", decision.text,
          {.description = "Why; empty: what was said of it before is removed.",
           .max_bytes = 4000});
}

template <typename Visitor>
void fields(Visitor& v, NightlyDecisions& decisions) {
  v.file("mapproof.decisions",
         "Decisions on findings and nightly runs, saved by the index of a history: mapproof history "
         "--from.");
  v.field("decisions", decisions.decisions, {.max_items = 10'000});
}

/// A decision as a note. @param option  Is named in messages.
/// @throws InvalidInput for a target that is none, a text with hidden characters, and a finding that
///         is to be accepted by itself.
NightlyNote note_of(const NightlyDecision& decision, std::string_view option);

/// The notes of such a file. @throws IoError, InvalidInput that name the file.
std::vector<NightlyNote> parse_decisions(std::string_view text, const std::string& source);

}  // namespace mapproof
