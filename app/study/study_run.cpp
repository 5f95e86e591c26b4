#include "app/study/study_run.hpp"

#include <algorithm>
#include <ctime>
#include <optional>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/utsname.h>

#include "app/build_facts.hpp"
#include "app/console.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/version.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/studies/shard.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

std::optional<double> peak_memory_mib() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return std::nullopt;
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB.
}

/// The value of the first line that begins with the key; empty if there is none.
std::string_view value_of(std::string_view text, std::string_view key) {
  constexpr std::string_view kBlank = " \t";
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string_view::npos ||
        line.substr(key.size(), colon - key.size()).find_first_not_of(kBlank) !=
            std::string_view::npos)
      continue;
    const std::size_t start = line.find_first_not_of(kBlank, colon + 1);
    return start == std::string_view::npos ? "" : line.substr(start);
  }
  return "";
}

void copy_study(const fs::path& from, const fs::path& to) {
  refuse_links_out(from);
  const LockedFolder study(to);
  const OutputFolder& copy = study.files();
  for (const fs::path& file : results_study_files(from)) copy.write(file, read_file(from / file));
}

}  // namespace

SessionClock::SessionClock()
    : started_utc_(fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))) {}

double SessionClock::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

Session SessionClock::session(const SessionNames& names, int jobs) const {
  return {.command = names.command,
          .started_utc = started_utc_,
          .host = names.host,
          .jobs = jobs,
          .seconds = seconds(),
          .peak_memory_mib = peak_memory_mib()};
}

void make_study(const StudyRequest& request, const fs::path& folder, int jobs,
                const SessionNames& names, const Console& console) {
  if (!request.texts.empty()) {
    const LockedFolder study(folder);
    if (request.table) {
      study.files().write(kResultsFile, "");
      write_results_csv(*request.table,
                        [&](const std::string& text) { study.files().append(kResultsFile, text); });
    }
    // With its last file the folder is a study: a table that was cut off is none.
    for (const auto& [file, text] : request.texts) study.files().write(file, text);
    return;
  }
  if (!request.given.empty()) {
    copy_study(request.given, folder);
    if (results_study_digest(folder) != request.digest)
      throw IoError(request.given.string(), kChangedWhileRead);
    return;
  }
  say_when_stopped(kContinuesWord);
  const SessionClock watch;
  std::optional<ProgressLine> line(std::in_place, console, "starting");
  for (const std::string& remark : request.plan.remarks) console.detail(remark);
  // The same shard may have been started twice; the second finds all done.
  const std::function<void()> busy = [&] {
    console.info(folder.string() + ": another mapproof works in it; waiting for it");
  };
  StudyWriter writer(folder, request.plan.start(build_provenance()),
                     request.shard ? busy : nullptr);
  if (!writer.redone().empty())
    console.warning(fmt::format("{}: its records were made by {}; they are made again",
                                folder.string(), writer.redone()));
  if (request.shard) {
    ShardSession session = *request.shard;
    session.command = names.command;
    session.processor = processor_kind();
    begin_shard(writer, session);
  }
  Progress last;
  run_study(request.plan, writer, jobs, [&](const Progress& progress) {
    last = progress;
    (*line)(progress);
  });
  if (last.reused < last.total) writer.write_session(watch.session(names, jobs));
  write_results_table(folder);
  line.reset();
  console.detail(fmt::format("{}: solver {}, commit {}, {} jobs, {:.2f} s", folder.string(),
                             solver_digest().substr(0, 12), source_commit(), jobs,
                             watch.seconds()));
  console.info(fmt::format("{}: {} {}, {} of them reused", folder.string(), last.total, last.noun,
                           last.reused));
}

std::string processor_kind() {
  utsname system{};
  const bool is_known = ::uname(&system) == 0;
  std::string cpuinfo;
  try {
    cpuinfo = read_file("/proc/cpuinfo");
  } catch (const IoError&) {  // Not every container shows it.
    cpuinfo.clear();
  }
  return processor_kind(cpuinfo, is_known ? system.machine : "unknown");
}

std::string processor_kind(std::string_view cpuinfo, std::string_view architecture) {
  std::string name(value_of(cpuinfo, "model name"));
  const std::string_view maker = value_of(cpuinfo, "CPU implementer");
  if (name.empty() && !maker.empty())
    name = fmt::format("implementer {}, part {}", maker, value_of(cpuinfo, "CPU part"));
  return printable(fmt::format("{} ({})", name.empty() ? "unknown" : name, architecture), 200);
}

}  // namespace mapproof
