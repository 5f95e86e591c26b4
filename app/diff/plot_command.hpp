#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mapproof {

/// A command that draws figures, and the folders around it.
struct PlotCommand {
  std::vector<std::string> words;   ///< The program and its arguments.
  std::filesystem::path writes;     ///< Where it writes; empty: in a new folder, its current one.
  std::filesystem::path candidate;  ///< Where what it wrote is kept.
  std::filesystem::path baseline;   ///< Never taken for something that it wrote.
};

/// Runs the command without a shell and without standard input; its output goes to standard error.
/// Without `writes` its current folder is `candidate`, and arguments that name files here are given
/// to it as absolute paths. With `writes` it runs here, and the files below that folder that it
/// wrote, also if with the bytes of before, are copied to `candidate`; hidden folders and links are
/// not. The environment variable MAPPROOF_SOURCE is the current folder of this process.
///
/// `candidate` is emptied first: a folder that is not an earlier candidate is refused.
/// @throws InvalidInput if the folders overlap, if the command fails, or if it wrote nothing that
///         can be compared; IoError. What it wrote stays in `candidate`.
void run_plot_command(const PlotCommand& command);

}  // namespace mapproof
