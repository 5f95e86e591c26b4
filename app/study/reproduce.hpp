#pragma once

#include "app/command_line.hpp"

namespace mapproof {

/// Each adds its options to the command's parser and returns its work (see AddCommand).
Action reproduce_command(CLI::App& app);

}  // namespace mapproof
