#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "app/nightly/nightly_study.hpp"
#include "reports/history/history_pages.hpp"
#include "reports/history/history_store.hpp"

namespace mapproof {

/// The number tonight gets: after all in the history and all finished folders, so that a history
/// that was begun anew takes none again. @throws IoError.
int next_night(HistoryStore& history, const std::filesystem::path& store);

/// Makes the folder of a night, or takes that of a night of the same orders that was killed, whose
/// runs then need not be made again; what a night of other orders left is removed. @throws IoError.
void begin_night(const std::filesystem::path& folder, const std::vector<StudyOrder>& orders,
                 const Console& console);

/// Notes in the folder what the night found; its presence says that the night was finished.
/// @throws IoError.
void end_night(const std::filesystem::path& folder, const Night& night);

/// What is left of nights that no history knows any more, since theirs was damaged: empty if none
/// was.
/// @param known  Those that the history has.
LostNights lost_nights(const std::filesystem::path& store, std::span<const NightFacts> known);

}  // namespace mapproof
