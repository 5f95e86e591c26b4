#pragma once

#include <chrono>
#include <string>

#include <nlohmann/json.hpp>

#include "core/topics/study_plan.hpp"

namespace mapproof {

/// What every command ends with.
enum ExitCode {
  kDone = 0,      ///< Done.
  kNo = 1,        ///< The check that was asked for says no, or there is no map.
  kUsage = 2,     ///< Usage or input.
  kInternal = 3,  ///< A fault of the program.
  kCostGrew = 4,  ///< Of nightly: only seconds or memory got worse.
};

/// How many messages go to standard error.
enum class Verbosity { kQuiet, kNormal, kVerbose };

/// Where a command talks: messages to standard error, its result to standard output.
class Console {
 public:
  /// @param command  Names the schema of the result: "mapproof.result.map".
  Console(Verbosity verbosity, bool json, std::string command);

  bool is_quiet() const { return verbosity_ == Verbosity::kQuiet; }

  /// What was done; not with --quiet.
  void info(const std::string& message) const;
  /// Details; with --verbose alone.
  void detail(const std::string& message) const;
  /// What a person should look at, --quiet or not.
  void warning(const std::string& message) const;

  /// The result: `text`, or with --json `object` behind the schema of the command's results; it
  /// names none of its own. Text that is not UTF-8 is corrected.
  void result(const std::string& text, const nlohmann::ordered_json& object) const;

 private:
  Verbosity verbosity_;
  bool json_;
  std::string command_;
};

/// Shows how far an experiment has come on standard error: one line that is redrawn on a terminal,
/// a plain line every five seconds elsewhere.
class ProgressLine {
 public:
  explicit ProgressLine(bool shown);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void operator()(const Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// "12 of 25 runs, 3.1 runs/s, 4 s left", after that many seconds.
std::string progress_text(const Progress& progress, double seconds);

}  // namespace mapproof
