#pragma once

#include "app/command_line.hpp"

namespace mapproof {

/// Each adds its options to the verb's parser and returns its work (see AddVerb).
Action reproduce_verb(CLI::App& app);
Action run_verb(CLI::App& app);
Action render_verb(CLI::App& app);
Action report_verb(CLI::App& app);
Action map_verb(CLI::App& app);
Action slam_verb(CLI::App& app);
Action approve_verb(CLI::App& app);
Action check_verb(CLI::App& app);
Action diff_verb(CLI::App& app);
Action methods_verb(CLI::App& app);
Action validate_verb(CLI::App& app);
Action nightly_verb(CLI::App& app);
Action history_verb(CLI::App& app);

}  // namespace mapproof
