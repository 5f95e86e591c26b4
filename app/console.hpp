#pragma once

#include <string>

#include <nlohmann/json.hpp>

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

}  // namespace mapproof
