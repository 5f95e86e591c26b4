#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/console.hpp"
#include "app/disclosure.hpp"
#include "core/model/experiment.hpp"
#include "core/model/slam/slam_experiment.hpp"
#include "core/studies/study_plan.hpp"

namespace mapproof {

/// What a command is given besides its own arguments.
struct Invocation {
  const Console& console;
  std::string command;  ///< As typed, quoted so that a shell takes it again, and disclosed.
  const Disclosure& disclosure;
};

/// A command's work once its arguments are parsed; returns an ExitCode.
using Action = std::function<int(const Invocation&)>;

/// Adds a command to the program: its options to `app`, its work to be returned.
using AddCommand = Action (*)(CLI::App& app);

/// The words of a command line, quoted for a POSIX shell where needed. A "~/" that a word begins
/// with stays what it is to a shell.
std::string quoted_command(const std::vector<std::string>& words);

/// Puts options into groups of help, by their names: {{"Input", {"OBSERVATIONS", "--sensor"}}}.
using OptionGroups = std::vector<std::pair<std::string, std::vector<std::string>>>;
void group_options(CLI::App& app, const OptionGroups& groups);

/// Lets at most one of these options be given. A group of options of the parser would do so, too,
/// but has an empty name, and so takes an empty word for the name of a command.
void exclude_one_another(CLI::App& app, const std::vector<std::string>& names);

/// Adds --jobs to a command: threads, by default one per core.
void add_jobs_option(CLI::App& app, int& jobs);

/// Adds --seed (a whole number from 0 to 2^64 - 1; others are refused, not wrapped round),
/// --layouts and --poses to a command.
void add_experiment_options(CLI::App& app, ExperimentChanges& changes);

/// Takes one of the words, in any case, and makes it that word; for CLI::Option::transform().
/// Others are refused with the nearest one.
CLI::Validator one_of(std::vector<std::string> words);

/// A finite number from `low` to `high`. CLI::Range takes NaN, which is neither below nor above.
CLI::Validator number_in(double low, double high);
/// The same above 0, from 0 on, and of any size.
CLI::Validator above_zero();
CLI::Validator not_negative();
CLI::Validator finite_number();

/// Refuses "-": standard input is not a folder.
CLI::Validator names_folder();

/// Adds --out to a command: a folder.
CLI::Option* add_out_option(CLI::App& app, std::string& out, const std::string& what);

}  // namespace mapproof
