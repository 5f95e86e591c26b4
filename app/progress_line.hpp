#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/topics/study_plan.hpp"

namespace mapproof {

class Console;

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
