#pragma once

#include "app/command_line.hpp"

namespace mapproof {

/// Adds its options to the command's parser and returns its work (see AddCommand).
Action render_command(CLI::App& app);

}  // namespace mapproof
