#include "app/nightly/nightly_folders.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "reports/history/history_export.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRequestFile = "request.txt";
constexpr const char* kEndFile = "nightly_run.json";

std::string request_text(const std::vector<StudyRequest>& requests) {
  std::string text;
  for (const StudyRequest& request : requests) text += request.digest + "  " + request.name + "\n";
  return text;
}

/// The number of a finished nightly run's folder; 0 for any other.
int finished_number(const fs::path& folder) {
  const std::string name = folder.filename().string();
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  std::error_code ignored;
  const bool is_number = error == std::errc() && end == name.data() + name.size();
  return is_number && fs::exists(folder / kEndFile, ignored) ? number : 0;
}

/// The names of what a folder holds, ascending; none if it is not there.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    names.push_back(entry->path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace

FolderLock lock_store(const fs::path& store, const fs::path& out,
                      const std::function<void()>& busy) {
  FolderLock lock(store, busy);
  remove_leftovers(store);
  if (std::error_code error; out != store && fs::is_directory(out, error)) remove_leftovers(out);
  return lock;
}

int next_nightly_run(HistoryStore& history, const fs::path& store) {
  int last = history.last_number();
  std::error_code error;
  for (fs::directory_iterator entry(store / "nightly_runs", error), end; !error && entry != end;
       entry.increment(error))
    last = std::max(last, finished_number(entry->path()));
  if (last == std::numeric_limits<int>::max())
    throw IoError(store.string(), fmt::format("no number is left after nightly run {}", last));
  return last + 1;
}

void begin_nightly_run(const fs::path& folder, const std::vector<StudyRequest>& requests,
                       const Console& console) {
  const std::string text = request_text(requests);
  std::error_code error;
  if (fs::exists(folder, error)) {
    std::string left;
    if (fs::exists(folder / kRequestFile, error)) left = read_file(folder / kRequestFile);
    if (left == text) {
      console.warning(folder.string() + ": continues a nightly run that was stopped");
      return;
    }
    console.warning(folder.string() +
                    ": removes the files of a stopped nightly run of other experiments");
    fs::remove_all(folder, error);
    if (error) throw IoError(folder.string(), "cannot be removed: " + error.message());
  }
  make_folder(folder);
  OutputFolder(folder).write(kRequestFile, text);
}

void end_nightly_run(const fs::path& folder, const NightlyRun& nightly_run) {
  OutputFolder(folder).write_durably(kEndFile, nightly_json(nightly_run));
}

std::set<std::string> comparisons_in(const fs::path& out) {
  std::set<std::string> files;
  std::error_code error;
  for (fs::directory_iterator pair(out / "compare", error), end; !error && pair != end;
       pair.increment(error)) {
    std::error_code inner;
    for (fs::directory_iterator page(pair->path(), inner); !inner && page != end;
         page.increment(inner))
      files.insert(page->path().lexically_relative(out).generic_string());
  }
  return files;
}

LostNightlyRuns lost_nightly_runs(const fs::path& store, std::span<const NightlyFacts> known) {
  LostNightlyRuns lost;
  for (const std::string& name : names_in(store))
    if (name.starts_with("history.sqlite.damaged-") && !name.ends_with("-journal") &&
        !name.ends_with("-wal") && !name.ends_with("-shm"))
      lost.kept_as.push_back(name);
  if (lost.kept_as.empty()) return lost;
  for (const std::string& name : names_in(store / "nightly_runs")) {
    const fs::path nightly_run = store / "nightly_runs" / name;
    const int number = finished_number(nightly_run);
    if (number == 0 || std::ranges::find(known, number, &NightlyFacts::number) != known.end())
      continue;
    std::error_code error;
    for (const std::string& study : names_in(nightly_run))
      if (fs::exists(nightly_run / study / "report.html", error))
        lost.reports[number].push_back(study);
  }
  return lost;
}

}  // namespace mapproof
