#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/console.hpp"

namespace mapproof {

/// What a verb is given beside its own arguments.
struct Invocation {
  const Console& console;
  std::string command;  ///< As typed, quoted so that a shell takes it again.
};

/// A verb's work once its arguments are parsed; returns an ExitCode.
using Action = std::function<int(const Invocation&)>;

/// Adds a verb to the program: its options to `app`, its work to be returned.
using Verb = Action (*)(CLI::App& app);

/// The words of a command line, quoted for a POSIX shell where needed.
std::string quoted_command(const std::vector<std::string>& words);

/// Adds --jobs to a verb: threads, by default one a core.
void add_jobs_option(CLI::App& app, int& jobs);

}  // namespace mapproof
