#pragma once

#include "app/command_line.hpp"

namespace mapproof {

/// The hidden command by which the build writes what describes the command line.
Action generate_command(CLI::App& app);

}  // namespace mapproof
