#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/files/byte_source.hpp"
#include "core/records/observations/input_summary.hpp"
#include "core/records/ranges/range_companions.hpp"

namespace mapproof {

/// What one file turned out to be.
struct Finding {
  std::string path;
  std::string kind;     ///< "mapproof.run 1", "wide CSV observations"; empty if not recognised.
  std::string problem;  ///< One line; empty if the file is fine.
  std::vector<std::string> remarks = {};   ///< What looks unusual in a fine one, a line each.
  std::vector<std::string> further = {};   ///< Of a table: problems after the first one, at most 9.
  std::optional<InputSummary> input = {};  ///< Of observations: what was understood.
  /// Of odometry, paths and positions: the same.
  std::optional<CompanionSummary> companion = {};
};

/// What a file is stated to be.
enum class InputRole {
  kAny,
  kOdometry,     ///< `slam --odometry`.
  kAnchors,      ///< Known positions of landmarks.
  kGroundTruth,  ///< True positions of landmarks, or a true path.
};

/// How tables are to be read, as `map` and `slam` take it.
struct ValidateOptions {
  TableFormat format = {};
  InputRole role = InputRole::kAny;
  /// A sensor's name, or "range-bearing"; empty: of detections what they hold, of other tables any
  /// that fits.
  std::string sensor = {};
};

/// Reads a JSON file of a schema that core does not know, e.g. "mapproof.figure"; throws IoError.
/// @return Whether it knows that schema.
using ForeignReader =
    std::function<bool(std::string_view schema, std::string_view text, const std::string& source)>;

/// Checks a file or stream, or every file of a study's or a map's folder, in the order of their
/// paths. Measured trouble is a finding, never an exception. JSON that mapproof writes and never
/// reads again, such as "mapproof.diff", is accepted by its heading alone; without `foreign`, so is
/// all that it writes and core does not know.
std::vector<Finding> validate(const std::filesystem::path& path,
                              const ForeignReader& foreign = nullptr,
                              const ValidateOptions& options = {});

/// Checks one file or stream.
Finding validate(ByteSource& source, const ForeignReader& foreign = nullptr,
                 const ValidateOptions& options = {});

}  // namespace mapproof
