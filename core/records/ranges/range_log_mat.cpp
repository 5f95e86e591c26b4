#include "core/records/ranges/range_log_forms.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <matio.h>

#include "core/base/angle.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/unpacker.hpp"
#include "core/base/not_finite.hpp"
#include "core/model/range_log.hpp"
#include "core/records/limits.hpp"
#include "core/records/ranges/range_log_assembly.hpp"
#include "core/records/ranges/range_tables.hpp"

namespace mapproof {
namespace {

/// A start and the motions that lead from it along a path.
struct RecoveredOdometry {
  StartPose start;
  std::vector<Motion> motions;  ///< T - 1.
};

constexpr double kShortest_m = 1e-9;

/// The heading at which each step is driven; a step of no length has that of the one before.
Eigen::VectorXd step_headings(const Points& steps_m, const Eigen::VectorXd& signs) {
  Eigen::VectorXd headings(steps_m.rows());
  Eigen::Index first = -1;
  for (Eigen::Index i = 0; i < steps_m.rows(); ++i) {
    if (steps_m.row(i).norm() > kShortest_m) {
      headings(i) = std::atan2(signs(i) * steps_m(i, 1), signs(i) * steps_m(i, 0));
      if (first < 0) first = i;
    } else if (first >= 0) {
      headings(i) = headings(i - 1);
    }
  }
  if (first < 0) return Eigen::VectorXd::Zero(steps_m.rows());
  headings.head(first).setConstant(headings(first));
  return headings;
}

/// The odometry that integrates to the positions of `path`, whose headings are not used: each
/// pose heads for the next one, so the last heading change is 0.
///
/// @param path  T >= 2 poses.
/// @param distances_m  T - 1, for their signs: where one is negative, the robot drove backwards.
///                     Empty: always forwards.
/// @note Steps below a nanometre keep the heading before them.
RecoveredOdometry motions_along(const Trajectory& path, const std::vector<double>& distances_m) {
  const Eigen::Index steps = path.size() - 1;
  if (steps < 1) throw InvalidInput("odometry needs a path of 2 poses or more");
  const Points steps_m = path.positions_m.bottomRows(steps) - path.positions_m.topRows(steps);
  Eigen::VectorXd signs = Eigen::VectorXd::Ones(steps);
  if (static_cast<Eigen::Index>(distances_m.size()) == steps)
    for (Eigen::Index i = 0; i < steps; ++i)
      signs(i) = distances_m[static_cast<std::size_t>(i)] < 0.0 ? -1.0 : 1.0;
  const Eigen::VectorXd headings = step_headings(steps_m, signs);

  RecoveredOdometry odometry{.start = {.time_s = path.time_s(0),
                                       .x_m = path.positions_m(0, 0),
                                       .y_m = path.positions_m(0, 1),
                                       .heading_rad = headings(0)},
                             .motions = {}};
  odometry.motions.reserve(static_cast<std::size_t>(steps));
  for (Eigen::Index i = 0; i < steps; ++i)
    odometry.motions.push_back(
        {.time_s = path.time_s(i + 1),
         .distance_m = signs(i) * steps_m.row(i).norm(),
         .heading_change_rad = i + 1 < steps ? wrapped(headings(i + 1) - headings(i)) : 0.0});
  return odometry;
}

constexpr std::size_t kHeaderBytes = 128;
constexpr std::size_t kTagBytes = 8;
constexpr std::size_t kMostColumns = 16;
constexpr std::size_t kMostVariables = 1000;

std::uint32_t word_at(const std::string& bytes, std::size_t at, bool is_swapped) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return is_swapped ? __builtin_bswap32(word) : word;
}

/// Whether the file's byte order is not this processor's. @throws IoError if it is no such file.
bool check_header(const std::string& bytes, const std::string& source) {
  if (bytes.size() < kHeaderBytes || !bytes.starts_with("MATLAB"))
    throw IoError(source, "is not a MATLAB file");
  std::uint16_t mark = 0;
  std::uint16_t version = 0;
  std::memcpy(&version, bytes.data() + 124, sizeof version);
  std::memcpy(&mark, bytes.data() + 126, sizeof mark);
  constexpr std::uint16_t kMark = 0x4D49;
  const bool is_swapped = mark == 0x494D;
  if (!is_swapped && mark != kMark)
    throw IoError(source, "is not a MATLAB file: no byte order mark");
  if (is_swapped) version = __builtin_bswap16(version);
  if (version != 0x0100)
    throw IoError(source, "is not of MATLAB 5 to 7.2: save it with -v7 or older");
  return is_swapped;
}

constexpr std::size_t kHeadBytes = 160;  // Flags, dimensions and name of a variable.

/// Whether the head is that of an array of doubles whose dimensions and name have possible sizes:
/// matio takes as much memory as they declare.
bool is_head_of_doubles(const std::string& head, bool is_swapped) {
  constexpr std::uint32_t kDoubles = 6;
  constexpr std::uint32_t kInt32 = 5;
  constexpr std::uint32_t kInt8 = 1;
  constexpr std::size_t kFlags = 8, kDimensions = 16, kName = 32;  // Of two dimensions.
  constexpr std::uint32_t kLongestName = 63;                       // Of MATLAB's.
  if (head.size() < kName + kTagBytes) return false;
  const auto word = [&](std::size_t at) { return word_at(head, at, is_swapped); };
  // The type of a name of up to four characters shares its word with their number.
  const bool has_name = word(kName) == kInt8
                            ? word(kName + 4) <= kLongestName
                            : (word(kName) & 0xFFFF) == kInt8 && word(kName) >> 16 <= 4;
  return (word(kFlags) & 0xFF) == kDoubles && word(kDimensions) == kInt32 &&
         word(kDimensions + 4) == 8 && has_name;
}

/// The variables of a file that may be tables.
struct MatTables {
  std::string bytes;  ///< A file of them alone.
  /// How many numbers the bytes of each could hold: a number has a byte or more, and a byte unpacks
  /// to 1032 at most.
  std::vector<std::size_t> most_numbers;
};

/// Follows the elements from tag to tag.
/// @throws IoError unless they are variables that fill the file.
MatTables tables_alone(const std::string& bytes, bool is_swapped, const std::string& source) {
  constexpr std::uint32_t kMatrix = 14;
  constexpr std::uint32_t kCompressed = 15;
  constexpr std::size_t kMostUnpacked = 1032;
  MatTables tables{.bytes = bytes.substr(0, kHeaderBytes), .most_numbers = {}};
  std::size_t count = 0;
  for (std::size_t at = kHeaderBytes; at < bytes.size();) {
    const std::string location = fmt::format("variable {}", ++count);
    if (count > kMostVariables)
      throw IoError(source, fmt::format("more than {} variables", kMostVariables));
    if (bytes.size() - at < kTagBytes) throw IoError(source, location, "is cut off");
    const std::uint32_t type = word_at(bytes, at, is_swapped);
    const std::size_t size = word_at(bytes, at + 4, is_swapped);
    if (type != kMatrix && type != kCompressed)
      throw IoError(source, location, fmt::format("is damaged: element of type {}", type));
    if (size > bytes.size() - at - kTagBytes) throw IoError(source, location, "is cut off");
    const std::size_t content = at + kTagBytes;
    const std::string_view element = std::string_view(bytes).substr(content, size);
    std::string head(element.substr(0, kHeadBytes));
    if (type == kCompressed) {  // A matrix with its tag.
      head = zlib_start(element, kTagBytes + kHeadBytes);
      head.erase(0, kTagBytes);
    }
    if (is_head_of_doubles(head, is_swapped)) {
      tables.bytes.append(bytes, at, kTagBytes + size);
      tables.most_numbers.push_back(type == kCompressed ? kMostUnpacked * size : size);
    }
    at = content + size;
  }
  return tables;
}

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatFile = std::unique_ptr<mat_t, CloseFile>;
using MatVariable = std::unique_ptr<matvar_t, FreeVariable>;

bool is_table(const matvar_t& variable) {
  return variable.class_type == MAT_C_DOUBLE && variable.rank == 2 && variable.isComplex == 0 &&
         variable.dims != nullptr;
}

/// @param most_numbers  That the bytes of the variable could hold.
NumberTable read_table(mat_t* file, matvar_t* variable, std::size_t most_numbers,
                       const std::string& source) {
  const std::string name = "variable " + printable(variable->name);
  const std::size_t rows = variable->dims[0];
  const std::size_t columns = variable->dims[1];
  if (rows > kMostSteps || columns > kMostColumns)
    throw IoError(
        source, name,
        fmt::format("{} x {} numbers; at most {} x {}", rows, columns, kMostSteps, kMostColumns));
  if (rows * columns > most_numbers)
    throw IoError(source, name,
                  fmt::format("is damaged: too short for {} x {} numbers", rows, columns));
  NumberTable table{
      .source = source, .row_word = name + ", row", .rows = std::vector<std::size_t>(rows)};
  std::iota(table.rows.begin(), table.rows.end(), std::size_t{1});
  table.values.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  if (table.values.size() == 0) return table;
  // Where a damaged file gives fewer numbers than it declares, matio leaves the rest as it was.
  table.values.setConstant(kNaN);
  std::array<int, 2> start = {0, 0};
  std::array<int, 2> stride = {1, 1};
  std::array<int, 2> count = {static_cast<int>(rows), static_cast<int>(columns)};
  if (Mat_VarReadData(file, variable, table.values.data(), start.data(), stride.data(),
                      count.data()) != 0)
    throw IoError(source, name, "is damaged");
  for (Eigen::Index row = 0; row < table.values.rows(); ++row)
    if (!table.values.row(row).allFinite()) table.fail(row, "a number is not finite");
  return table;
}

/// The tables of real doubles in a MATLAB 5 file (that of MATLAB 5 to 7.2), by the name of their
/// variable. Variables of other kinds are passed over.
///
/// @throws IoError naming the variable if the file is of another version, cut off or damaged; if a
///         table has more than 1e6 rows or 16 columns; or if a number is not finite.
/// @note The frame of the file is checked here, since matio trusts it.
std::map<std::string, NumberTable> read_mat_tables(ByteSource& input) {
  const std::string& source = input.name();
  const std::string bytes = input.rest();
  const bool is_swapped = check_header(bytes, source);
  const MatTables alone = tables_alone(bytes, is_swapped, source);
  const std::vector<std::size_t>& most = alone.most_numbers;
  // matio seeks, and opens by a name: it gets the very bytes that were checked.
  const Descriptor seekable = anonymous_file(alone.bytes, source);
  const MatFile file(Mat_Open(path_of(seekable).c_str(), MAT_ACC_RDONLY));
  if (!file) throw IoError(source, "is not a MATLAB file");

  // All heads first: reading numbers moves the position from which matio reads the next head.
  std::vector<MatVariable> variables;
  for (std::size_t i = 0; i < most.size(); ++i) {
    variables.emplace_back(Mat_VarReadNextInfo(file.get()));
    if (!variables.back()) throw IoError(source, fmt::format("variable {}", i + 1), "is damaged");
  }
  std::map<std::string, NumberTable> tables;
  for (std::size_t i = 0; i < most.size(); ++i) {
    matvar_t* const variable = variables[i].get();
    if (variable->name == nullptr || !is_table(*variable)) continue;
    if (!tables.emplace(variable->name, read_table(file.get(), variable, most[i], source)).second)
      throw IoError(source, "variable " + printable(variable->name), "is there twice");
  }
  return tables;
}

using Tables = std::map<std::string, NumberTable>;

/// The table, if it is there. @throws IoError if it has rows but other than `columns` columns.
const NumberTable* table_of(const Tables& tables, const std::string& name, Eigen::Index columns) {
  const auto found = tables.find(name);
  if (found == tables.end() || found->second.values.rows() == 0) return nullptr;
  if (found->second.values.cols() != columns)
    throw IoError(found->second.source, "variable " + name,
                  fmt::format("{} columns, expected {}", found->second.values.cols(), columns));
  return &found->second;
}

bool has_same_times(const NumberTable& path, const NumberTable& motions) {
  const Eigen::Index steps = motions.values.rows();
  return path.values.rows() == steps + 1 && path.values.col(0).tail(steps) == motions.values.col(0);
}

/// The positions of DRp are what the robot's own gyro gave, whatever stands in DR.
void take_odometry(const Tables& tables, OdometrySource source, RangeLogParts& parts) {
  const NumberTable* motions = table_of(tables, "DR", 3);
  const NumberTable* path = table_of(tables, "DRp", 4);
  if (motions != nullptr) parts.odometry = motions_in(*motions);
  if (path == nullptr || path->values.rows() < 2) {
    if (motions != nullptr)
      parts.remarks.push_back("There is no DRp: the odometry is DR as it stands.");
    return;
  }
  const Trajectory dead_reckoned = trajectory_in(*path);
  if (source == OdometrySource::kAsGiven && motions != nullptr) {
    parts.start = {.time_s = dead_reckoned.time_s(0),
                   .x_m = dead_reckoned.positions_m(0, 0),
                   .y_m = dead_reckoned.positions_m(0, 1),
                   .heading_rad = dead_reckoned.heading_rad(0)};
    return;
  }
  std::vector<double> distances_m;
  if (motions != nullptr && has_same_times(*path, *motions))
    for (const Motion& motion : parts.odometry) distances_m.push_back(motion.distance_m);
  RecoveredOdometry recovered = motions_along(dead_reckoned, distances_m);
  parts.start = recovered.start;
  parts.odometry = std::move(recovered.motions);
  parts.remarks.push_back("The odometry is recovered from the positions in DRp.");
}

/// What stands in DR is worth a word even where it is not used.
void check_given_turns(const Tables& tables, RangeLogParts& parts) {
  const NumberTable* motions = table_of(tables, "DR", 3);
  const NumberTable* ground_truth = table_of(tables, "GT", 4);
  if (motions == nullptr || ground_truth == nullptr) return;
  if (turns_are_the_ground_truths(motions_in(*motions), trajectory_in(*ground_truth)))
    parts.remarks.push_back(
        "The heading increments of DR are those of the true heading, not the robot's gyro.");
}

}  // namespace

RangeLog read_range_log_mat(ByteSource& source, const RangeLogOptions& options) {
  const Tables tables = read_mat_tables(source);
  RangeLogParts parts{.source = source.name(), .name = options.name};
  const NumberTable* ranges = table_of(tables, "TD", 4);
  if (ranges == nullptr)
    throw IoError(parts.source, "has no variable TD of ranges: time, sender, landmark, range");
  check_one_sender(*ranges, 1);
  parts.measurements = measurements_in(selected(*ranges, {0, 3}, 2));
  take_odometry(tables, options.odometry, parts);
  check_given_turns(tables, parts);
  if (const NumberTable* ground_truth = table_of(tables, "GT", 4))
    parts.ground_truth = trajectory_in(*ground_truth);
  if (const NumberTable* landmarks = table_of(tables, "TL", 3))
    parts.true_landmarks = landmarks_in(selected(*landmarks, {1, 2}, 0));
  return assemble(std::move(parts), options);
}

}  // namespace mapproof
