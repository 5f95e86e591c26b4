#include "app/diff/plot_command.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <system_error>

#include <fmt/format.h>

#include "app/command_line.hpp"
#include "core/base/child_process.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "reports/diff/folder_diff.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Identifies a folder that may be emptied.
constexpr const char* kMark = ".mapproof-candidate";

/// Changes whenever a file is written.
using Stamp = std::array<std::int64_t, 6>;

Stamp stamp_of(const struct stat& status) {
  return {static_cast<std::int64_t>(status.st_ino),
          status.st_size,
          status.st_mtim.tv_sec,
          status.st_mtim.tv_nsec,
          status.st_ctim.tv_sec,
          status.st_ctim.tv_nsec};
}

/// The regular files below a folder.
std::map<fs::path, Stamp> files_below(const PlotCommand& command) {
  std::map<fs::path, Stamp> files;
  const std::array skipped = {real_path(command.candidate), real_path(command.baseline)};
  std::error_code error;
  if (!fs::exists(command.writes, error)) return files;
  fs::recursive_directory_iterator entry(command.writes, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    struct stat status {};
    if (::lstat(entry->path().c_str(), &status) != 0) continue;
    if (S_ISDIR(status.st_mode)) {
      const bool is_hidden = entry->path().filename().string().starts_with('.');
      if (is_hidden || std::ranges::find(skipped, real_path(entry->path())) != skipped.end())
        entry.disable_recursion_pending();
    } else if (S_ISREG(status.st_mode)) {
      files[entry->path()] = stamp_of(status);
    }
  }
  if (error) throw IoError(command.writes.string(), "cannot be listed: " + error.message());
  return files;
}

void empty_candidate(const fs::path& candidate) {
  std::error_code error;
  if (fs::exists(candidate, error) && !fs::is_directory(candidate, error))
    throw IoError(candidate.string(), "is not a folder");
  const bool is_ours = fs::is_regular_file(candidate / kMark, error);
  if (!is_ours && fs::exists(candidate, error) && !fs::is_empty(candidate, error))
    throw InvalidInput(
        fmt::format("--out {}: holds files that no earlier \"mapproof check -- COMMAND\" wrote; "
                    "name another folder",
                    printable(candidate.string())));
  make_folder(candidate);
  const FolderLock lock(candidate);
  const OutputFolder folder(candidate);
  folder.write(kMark, "The next \"mapproof check\" empties this folder.\n");
  for (const fs::directory_entry& entry : fs::directory_iterator(candidate))
    if (entry.path().filename() != kMark) folder.remove(entry.path().filename());
}

void check_folders(const PlotCommand& command) {
  if (command.writes.empty()) return;
  const fs::path writes = real_path(command.writes);
  if (lies_in(writes, real_path(command.candidate)))
    throw InvalidInput(fmt::format("--writes {} is --out or lies in it, which is emptied",
                                   printable(command.writes.string())));
  if (!command.baseline.empty() && lies_in(writes, real_path(command.baseline)))
    throw InvalidInput(
        fmt::format("--writes {} is the baseline or lies in it. What git has of it can be the "
                    "baseline: --baseline-ref HEAD:{}",
                    printable(command.writes.string()), printable(command.writes.string())));
}

/// An argument for a program that runs in another folder.
std::string argument_elsewhere(const std::string& word) {
  std::error_code error;
  const fs::path path(word);
  if (word.empty() || path.is_absolute() || !fs::is_regular_file(path, error)) return word;
  return (fs::current_path() / path).string();
}

/// The command as env takes it: env finds the program by PATH, and starts it in a folder.
ProgramCall call_of(const PlotCommand& command) {
  const bool here = !command.writes.empty();
  ProgramCall call{.program = "/usr/bin/env",
                   .arguments = {"-C", here ? "." : command.candidate.string(), "--",
                                 "MAPPROOF_SOURCE=" + fs::current_path().string()}};
  for (std::size_t i = 0; i < command.words.size(); ++i) {
    const std::string& word = command.words[i];
    // A program without a slash is found by PATH, whatever lies here.
    const bool by_path = i == 0 && word.find('/') == std::string::npos;
    call.arguments.push_back(here || by_path ? word : argument_elsewhere(word));
  }
  return call;
}

void run(const PlotCommand& command) {
  constexpr int kNotFound = 127;  // As env and shells end then.
  constexpr std::size_t kLongest = 500;
  const Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  const std::string shown = printable(quoted_command(command.words), kLongest);
  ProcessEnd end;
  try {
    ChildProcess process(call_of(command), {.input = nothing.get(), .output = STDERR_FILENO});
    end = process.wait();
  } catch (const ProcessError& error) {
    throw InvalidInput(fmt::format("{}: {}", shown, error.what()));
  }
  if (end.is_success()) return;
  throw InvalidInput(fmt::format("{}: {}{}; nothing was compared", shown, end.text(),
                                 end.exit_code == kNotFound ? " (no such program)" : ""));
}

void copy_written(const PlotCommand& command, const std::map<fs::path, Stamp>& before) {
  for (const auto& [file, stamp] : files_below(command)) {
    const auto earlier = before.find(file);
    if (earlier != before.end() && earlier->second == stamp) continue;
    const fs::path target = command.candidate / file.lexically_relative(command.writes);
    make_folder(target.parent_path());
    std::error_code error;
    fs::copy_file(file, target, fs::copy_options::overwrite_existing, error);
    if (error) throw IoError(file.string(), "cannot be copied: " + error.message());
  }
}

}  // namespace

void run_plot_command(const PlotCommand& command) {
  check_folders(command);
  empty_candidate(command.candidate);
  const FolderLock lock(command.candidate);
  const std::map<fs::path, Stamp> before =
      command.writes.empty() ? std::map<fs::path, Stamp>() : files_below(command);
  run(command);
  if (!command.writes.empty()) copy_written(command, before);
  if (holds_items(command.candidate)) return;
  const std::string shown = printable(quoted_command(command.words));
  throw InvalidInput(
      command.writes.empty()
          ? fmt::format("{}: it wrote no figure, image or table in its folder {}. If it writes "
                        "elsewhere, name that folder with --writes",
                        shown, printable(command.candidate.string()))
          : fmt::format("{}: it wrote no figure, image or table below {}", shown,
                        printable(command.writes.string())));
}

}  // namespace mapproof
