#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "app/nightly/nightly_study.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/pages/index_facts.hpp"

namespace mapproof {

/// Locks a store, and removes what killed processes left behind in it and in the folder of its
/// pages.
/// @param out   Of the pages; it may be the store, or not be there yet.
/// @param busy  Called once before a wait for another process.
/// @throws IoError as FolderLock and remove_leftovers().
FolderLock lock_store(const std::filesystem::path& store, const std::filesystem::path& out,
                      const std::function<void()>& busy);

/// The number this nightly run gets: after all in the history and all finished folders, so that a
/// new history takes none again. @throws IoError.
int next_nightly_run(HistoryStore& history, const std::filesystem::path& store);

/// Makes the folder of a nightly run, or takes that of a nightly run of the same requests that was
/// killed, whose runs then need not be made again; what a nightly run of other requests left is
/// removed. @throws IoError.
void begin_nightly_run(const std::filesystem::path& folder,
                       const std::vector<StudyRequest>& requests, const Console& console);

/// Notes in the folder what the nightly run found; its presence says that the nightly run was
/// finished.
/// @throws IoError.
void end_nightly_run(const std::filesystem::path& folder, const NightlyRun& nightly_run);

/// comparison_file() of every page that is there. @param out  The folder of the pages.
std::set<std::string> comparisons_in(const std::filesystem::path& out);

/// What is left of nightly runs that no history knows any more, since theirs was damaged: empty if
/// none was.
/// @param known  Those that the history has.
LostNightlyRuns lost_nightly_runs(const std::filesystem::path& store,
                                  std::span<const NightlyFacts> known);

}  // namespace mapproof
