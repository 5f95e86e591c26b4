#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

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
  /// As result() with --json, of an object that has one array, which is written item by item.
  void list(const std::string& key, std::size_t count,
            const std::function<nlohmann::ordered_json(std::size_t)>& item) const;
  /// The result where it has a form of its own, as it stands. @throws IoError.
  void print(const std::string& text) const;

 private:
  std::string json_text(const nlohmann::ordered_json& object) const;

  Verbosity verbosity_;
  bool json_;
  std::string command_;
};

/// Shows on standard error what a command does until it is destroyed: one line that is redrawn on a
/// terminal, within half a second and then at least every second ("mapping, 12 s"); a plain line
/// every five seconds elsewhere, of progress alone. Nothing with --quiet. Safe from any thread.
class ProgressLine {
 public:
  /// @param doing  Shown until there is progress: "mapping".
  ProgressLine(const Console& console, std::string doing);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void operator()(const Progress& progress);
  /// "drawing 7 of 23".
  void show(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;

  void redraw();
  double seconds() const;

  bool shown_;
  bool terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  std::string text_;  ///< Guarded, as last_, by the mutex of the terminal.
  std::mutex mutex_;  ///< Of what follows.
  std::condition_variable ends_;
  bool ended_ = false;
  std::thread redrawing_;  ///< On a terminal alone.
};

/// Removes the line that is redrawn from the terminal, so that a message can be written. Safe from
/// any thread.
void wipe_progress_line();

/// Says what it is called with, see Console::info(). The console has to outlive it.
std::function<void(const std::string&)> note_to(const Console& console);

/// Called with how many of how many are done.
using CountProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Shows "drawing 7 of 23" until it is destroyed.
CountProgress count_progress(const Console& console, std::string doing);

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
