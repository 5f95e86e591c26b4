#pragma once

#include "app/command_line.hpp"

namespace mapproof {

/// The register of commands; app/mapproof.cpp names them. Each adds its options to the command's
/// parser and returns its work (see AddCommand). NAME_command is defined in app/FOLDER/NAME.cpp.
Action reproduce_command(CLI::App& app);
Action example_command(CLI::App& app);
Action run_command(CLI::App& app);
Action merge_command(CLI::App& app);
Action render_command(CLI::App& app);
Action report_command(CLI::App& app);
Action results_command(CLI::App& app);
Action map_command(CLI::App& app);
Action slam_command(CLI::App& app);
Action evaluate_command(CLI::App& app);
Action export_command(CLI::App& app);
Action import_command(CLI::App& app);
Action diff_command(CLI::App& app);
Action approve_command(CLI::App& app);
Action check_command(CLI::App& app);
Action methods_command(CLI::App& app);
Action validate_command(CLI::App& app);
Action nightly_command(CLI::App& app);
Action history_command(CLI::App& app);
/// Hidden: the build writes by it what describes the command line.
Action generate_command(CLI::App& app);

}  // namespace mapproof
