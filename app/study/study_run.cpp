#include "app/study/study_run.hpp"

#include <chrono>
#include <ctime>
#include <optional>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include "app/build_facts.hpp"
#include "app/console.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/version.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

std::optional<double> peak_memory_mib() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return std::nullopt;
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB.
}

/// When a session began.
struct Stopwatch {
  using Clock = std::chrono::steady_clock;
  Clock::time_point start = Clock::now();
  std::string started_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start).count(); }
};

void copy_study(const fs::path& from, const fs::path& to) {
  refuse_links_out(from);
  make_folder(to);
  const OutputFolder copy(to);
  for (const fs::path& file : results_study_files(from)) copy.write(file, read_file(from / file));
}

}  // namespace

void make_study(const StudyRequest& request, const fs::path& folder, int jobs,
                const SessionNames& names, const Console& console) {
  if (!request.texts.empty()) {
    make_folder(folder);
    for (const auto& [file, text] : request.texts) OutputFolder(folder).write(file, text);
    return;
  }
  if (!request.given.empty()) {
    copy_study(request.given, folder);
    return;
  }
  say_when_stopped(kContinuesWord);
  const Stopwatch watch;
  std::optional<ProgressLine> line(std::in_place, console, "starting");
  for (const std::string& remark : request.plan.remarks) console.detail(remark);
  StudyWriter writer(folder, request.plan.start(build_provenance()));
  if (!writer.redone().empty())
    console.warning(fmt::format("{}: its records were made by {}; they are made again",
                                folder.string(), writer.redone()));
  Progress last;
  run_study(request.plan, writer, jobs, [&](const Progress& progress) {
    last = progress;
    (*line)(progress);
  });
  if (last.reused < last.total)
    writer.write_session({.command = names.command,
                          .started_utc = watch.started_utc,
                          .host = names.host,
                          .jobs = jobs,
                          .seconds = watch.seconds(),
                          .peak_memory_mib = peak_memory_mib()});
  write_results_table(folder);
  line.reset();
  console.detail(fmt::format("{}: solver {}, commit {}, {} jobs, {:.2f} s", folder.string(),
                             solver_digest().substr(0, 12), source_commit(), jobs,
                             watch.seconds()));
  console.info(fmt::format("{}: {} {}, {} of them reused", folder.string(), last.total, last.noun,
                           last.reused));
}

}  // namespace mapproof
