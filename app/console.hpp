#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "app/exit_codes.hpp"
#include "core/studies/study_plan.hpp"

namespace mapproof {

/// How many messages go to standard error.
enum class Verbosity { kQuiet, kNormal, kVerbose };

/// Where a command talks: messages to standard error, its result to standard output.
class Console {
 public:
  /// @param command  Names the schema of the result: "mapproof.result.map".
  Console(Verbosity verbosity, bool json, std::string command);

  bool is_quiet() const { return verbosity_ == Verbosity::kQuiet; }
  /// Whether the result is asked for as JSON.
  bool is_json() const { return json_; }

  /// What was done; not with --quiet.
  void info(const std::string& message) const;
  /// Details; with --verbose alone.
  void detail(const std::string& message) const;
  /// What a person should look at, --quiet or not.
  void warning(const std::string& message) const;

  /// The result: `text`, or with --json `object` behind the schema of the command's results; it
  /// names none of its own. Text that is not UTF-8 is corrected.
  void result(const std::string& text, const nlohmann::ordered_json& object) const;
  /// The result where it has a form of its own, as it stands. @throws IoError.
  void print(const std::string& text) const;

 private:
  Verbosity verbosity_;
  bool json_;
  std::string command_;
};

/// Shows how far a command has come on standard error: one line that is redrawn on a terminal, a
/// plain line every five seconds elsewhere. Safe from any thread.
class ProgressLine {
 public:
  explicit ProgressLine(bool shown);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void operator()(const Progress& progress);
  /// "drawing 7 of 23".
  void show(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_;
  bool terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// Removes the line that is redrawn from the terminal, so that a message can be written. Safe from
/// any thread.
void wipe_progress_line();

/// Called with how many of how many are done.
using CountProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Shows "drawing 7 of 23" until it is destroyed.
CountProgress count_progress(const Console& console, std::string doing);

/// Shows "mapping, 12 s" on a terminal from the first second on, until it is destroyed.
class WorkingLine {
 public:
  WorkingLine(const Console& console, std::string doing);
  ~WorkingLine();
  WorkingLine(const WorkingLine&) = delete;
  WorkingLine& operator=(const WorkingLine&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// "12 of 25 runs, 3.1 runs/s, 4 s left", after that many seconds.
std::string progress_text(const Progress& progress, double seconds);

/// What a command says that has nothing better to say.
inline constexpr std::string_view kStoppedWord = "stopped; no file was left half written";
/// What one says that goes on where it was stopped.
inline constexpr std::string_view kContinuesWord = "stopped; the same command continues";

/// On SIGINT and SIGTERM the program says `last_word` on standard error, without its progress line,
/// and ends by the signal. A later call replaces the word.
void say_when_stopped(std::string_view last_word);

}  // namespace mapproof
