#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// What a note does.
enum class NoteKind {
  kNote,      ///< It is shown.
  kKnown,     ///< Its findings are known: they fail no nightly run until they get worse.
  kAccepted,  ///< Its nightly run is the new reference.
};

/// "note", "known", "accepted".
std::string_view name(NoteKind kind);
std::optional<NoteKind> note_kind_named(std::string_view name);

/// What a person said of a nightly run, or of one of its findings.
struct NightlyNote {
  int nightly_run = 0;
  int finding = 0;  ///< Its index among those of the nightly run, from 1; 0: all.
  NoteKind kind = NoteKind::kNote;
  std::string study = {}, subject = {}, quantity = {};  ///< Of that finding.
  int since = 0;                                        ///< Likewise.
  std::optional<double> change = {};                    ///< Likewise.
  std::string text = {};
  std::string written_utc = {};
};

/// Copies to the note what it needs of its finding: the nightly run may be pruned.
void put_finding(NightlyNote& note, const NightlyFinding& finding);

/// "7.2": finding 2 of nightly run 7; "7": the nightly run. @throws InvalidInput for other texts.
/// @param option  Is named in the message.
NightlyNote parse_note_target(const std::string& text, std::string_view option);

/// One note per finding of a nightly run for one on all of them; any other note as it is. A finding
/// that is known is known by itself: others of its nightly run may be fixed before.
std::vector<NightlyNote> by_finding(const NightlyNote& note,
                                    std::span<const NightlyFinding> findings);

/// The note by which a finding is known: of the same study, subject and quantity, begun in the same
/// nightly run, and not worse by the limit of its rule than it was then. Null if there is none.
const NightlyNote* known_by(std::span<const NightlyNote> notes, const NightlyFinding& finding);

/// Those that no note has as known.
std::vector<NightlyFinding> new_findings(std::span<const NightlyFinding> findings,
                                         std::span<const NightlyNote> notes);

/// Those that people noted on a nightly run or on its findings.
std::vector<NightlyNote> notes_on(int nightly_run, std::span<const NightlyNote> notes);

}  // namespace mapproof
