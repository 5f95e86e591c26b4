#include "reports/history/nightly_decisions.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/record_reader.hpp"

namespace mapproof {

NightlyNote note_of(const NightlyDecision& decision, std::string_view option) {
  constexpr std::size_t kLongest = 1000;
  NightlyNote note = parse_note_target(decision.target, option);
  note.kind = decision.decision;
  note.text = decision.text;
  if (printable(note.text, kLongest) != note.text)
    throw InvalidInput(fmt::format("{}: the text holds hidden characters or more than {}: \"{}\"",
                                   option, kLongest, printable(note.text, 40)));
  if (note.kind == NoteKind::kAccepted && note.finding > 0)
    throw InvalidInput(fmt::format(
        "{}: a nightly run is accepted as a whole: \"{}\"; a finding by itself can be known",
        option, note.nightly_run));
  return note;
}

std::vector<NightlyNote> parse_decisions(std::string_view text, const std::string& source) {
  std::vector<NightlyNote> notes;
  for (const NightlyDecision& decision : from_json_text<NightlyDecisions>(text, source).decisions)
    notes.push_back(note_of(decision, source));
  return notes;
}

}  // namespace mapproof
