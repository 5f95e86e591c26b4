#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluate/evaluation_rows.hpp"
#include "core/model/paths/space_path.hpp"

namespace mapproof {

/// The path, the landmarks, or both, of one file.
struct EvaluatedFile {
  std::optional<SpacePath> path = {};
  std::optional<LandmarkPositions> landmarks = {};
};

/// Reads a trajectory (TUM, KITTI, EuRoC, CSV with t, x, y and perhaps heading), a map of landmarks
/// (CSV with name, x, y) or a g2o file, which may hold both. @throws IoError with the line.
EvaluatedFile read_evaluated_file(const std::filesystem::path& file);

/// An estimate, and the ground truth that it belongs to.
struct EstimateFile {
  EvaluatedRun run = {};            ///< Its names; nothing is compared yet.
  std::size_t ground_truth = 0;     ///< Its row among the files of the ground truth.
  std::filesystem::path file = {};  ///< Empty: the system has none of this sequence.
};

/// What is to be compared.
struct EvaluationPlan {
  std::vector<std::filesystem::path> ground_truths;
  std::vector<EstimateFile> estimates;  ///< By system in the order given, then by run.
};

/// Assigns estimates to ground truths.
///
/// @param ground_truths  Files, or folders of one file per sequence.
/// @param estimates      FILE, FOLDER, SYSTEM=FILE or SYSTEM=FOLDER. Without a name the system is
///        called as the file (its folder, if there are several ground truths), or the folder.
///        With one ground truth every file is a run of it. With several, a file belongs to the one
///        whose name, without "groundtruth" or "gt" at its end, it has or begins with; a system
///        without a file of a sequence has lost it.
/// @throws InvalidInput, IoError if a file belongs to none, or names cannot be those of files.
EvaluationPlan plan_evaluation(const std::vector<std::string>& ground_truths,
                               const std::vector<std::string>& estimates);

}  // namespace mapproof
