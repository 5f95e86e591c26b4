#include "core/records/ranges/range_log_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/ranges/range_log_assembly.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {
namespace {

/// Stamps nearer to each other than this are the same.
constexpr double kSameTime_s = 1e-6;

/// The letters before the number in a pose's name: one robot has one.
std::string_view prefix_of(std::string_view name) {
  return name.substr(0, name.find_first_of("0123456789"));
}

/// Gathers the lines of a PyFG file: vertices before the edges that name them.
class PyfgLines {
 public:
  PyfgLines(std::string_view text, const std::string& source)
      : source_(source), reader_(text, source, TableReader::kBlanks) {
    for (NumberTable* table : {&poses_, &motions_, &ranges_, &landmarks_}) table->source = source;
  }

  void read() {
    while (reader_.next(row_)) take_row();
    number_stamps();
    if (pose_rows_.size() != motions_by_pose_.size() + 1)
      throw IoError(source_, fmt::format("{} odometry edges for {} poses: one less is expected",
                                         motions_by_pose_.size(), pose_rows_.size()));
  }

  /// Stamps that do not ascend from pose to pose order nothing: the poses are then numbered.
  void number_stamps() {
    const auto stamp = [&](std::size_t pose) -> double& { return pose_values_[4 * pose]; };
    bool ascends = true;
    for (std::size_t i = 1; i < pose_rows_.size(); ++i) ascends &= stamp(i) > stamp(i - 1);
    if (ascends) return;
    is_numbered_ = true;
    for (std::size_t i = 0; i < pose_rows_.size(); ++i) stamp(i) = static_cast<double>(i);
    for (std::size_t i = 0; i < range_poses_.size(); ++i)
      range_values_[2 * i] = static_cast<double>(range_poses_[i]);
  }

  Trajectory ground_truth() const { return trajectory_in(filled(poses_, pose_values_, 4)); }
  NamedPoints landmarks() const { return landmarks_in(filled(landmarks_, landmark_values_, 2)); }
  std::vector<NamedMeasurement> measurements() const {
    std::vector<NamedMeasurement> all = measurements_in(filled(ranges_, range_values_, 2));
    for (std::size_t i = 0; i < all.size(); ++i) all[i].sigma_m = std::sqrt(variances_[i]);
    return all;
  }

  /// In the order of the poses, stamped with them.
  std::vector<Motion> motions() const {
    NumberTable table = motions_;
    std::vector<double> values;
    for (const auto& [pose, motion] : motions_by_pose_) {
      table.rows.push_back(motion.line);
      values.push_back(time_s(pose));
      values.insert(values.end(), motion.step.begin(), motion.step.end());
    }
    std::vector<Motion> motions = motions_in(filled(table, values, 4));
    std::size_t i = 0;
    for (const auto& [pose, motion] : motions_by_pose_) {
      const Eigen::Vector3d variances(motion.variances[0], motion.variances[1],
                                      motion.variances[2]);
      if ((variances.array() > 0.0).all()) motions[i].sigmas = variances.cwiseSqrt();
      ++i;
    }
    return motions;
  }

  std::vector<std::string> remarks() const {
    std::vector<std::string> remarks = {"The start is the first vertex."};
    if (is_numbered_)
      remarks.push_back(
          "The stamps of the poses do not ascend: a second is taken from each pose to the next.");
    if (other_stamps_ > 0 && !is_numbered_)
      remarks.push_back(
          fmt::format("{} stamped otherwise than the poses, by up to {:.3g} s: the times are those "
                      "of the poses.",
                      counted(other_stamps_, "edge"), farthest_s_));
    if (passed_over_ > 0)
      remarks.push_back(
          fmt::format("{} passed over: priors and edges to landmarks other than ranges.",
                      counted(passed_over_, "line")));
    return remarks;
  }

 private:
  struct Step {
    std::size_t line;
    std::array<double, 3> step;       ///< Forward, heading change, sideways.
    std::array<double, 3> variances;  ///< Forward, sideways, of the heading change.
  };

  static NumberTable filled(NumberTable table, const std::vector<double>& values,
                            Eigen::Index width) {
    table.set_values(values, width);
    return table;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(source_, fmt::format("line {}", row_.line), what);
  }

  void take_row() {
    const std::string_view kind = row_.cells[0];
    if (kind.starts_with("VERTEX_SE3") || kind.starts_with("VERTEX_XYZ") ||
        kind.starts_with("EDGE_SE3"))
      fail("is three-dimensional: " + in_quotes(kind) + "; maps are of the plane");
    if (kind == "VERTEX_SE2")
      add_pose();
    else if (kind == "VERTEX_XY")
      add_landmark();
    else if (kind == "EDGE_SE2")
      add_motion();
    else if (kind == "EDGE_RANGE")
      add_range();
    else if (kind == "VERTEX_SE2:PRIOR" || kind == "VERTEX_XY:PRIOR" || kind == "EDGE_SE2_XY")
      ++passed_over_;
    else
      fail("unknown record " + in_quotes(kind));
  }

  void expect_cells(std::size_t count) const {
    if (row_.cells.size() != count)
      fail(fmt::format("has {} cells, expected {}", row_.cells.size(), count));
  }

  double number(std::size_t cell) const {
    const std::optional<double> value = number_in(row_.cells[cell]);
    if (!value || !std::isfinite(*value)) fail(number_problem(row_.cells[cell]));
    return *value;
  }

  void check_count(const NumberTable& table, std::string_view what) const {
    if (table.rows.size() == kMostSteps) fail(fmt::format("more than {} {}", kMostSteps, what));
  }

  /// The stamp of an edge is no more than noticed: times are those of the poses.
  void compare_stamp(Eigen::Index from, Eigen::Index to) {
    const double stamp_s = number(1);
    const double gap_s = std::min(std::abs(stamp_s - time_s(from)), std::abs(stamp_s - time_s(to)));
    if (!(gap_s > kSameTime_s)) return;
    ++other_stamps_;
    farthest_s_ = std::max(farthest_s_, gap_s);
  }

  double time_s(Eigen::Index pose) const {
    return pose_values_[4 * static_cast<std::size_t>(pose)];
  }

  void add_pose() {
    expect_cells(6);
    const std::string_view name = row_.cells[2];
    if (poses_.rows.empty())
      first_pose_ = name;
    else if (prefix_of(name) != prefix_of(first_pose_))
      fail(fmt::format("pose {} is of another robot than {}: give the lines of one robot",
                       in_quotes(name), in_quotes(first_pose_)));
    check_count(poses_, "poses");
    if (!pose_rows_.emplace(name, static_cast<Eigen::Index>(pose_rows_.size())).second)
      fail("pose " + in_quotes(name) + " is there twice");
    poses_.rows.push_back(row_.line);
    for (const std::size_t cell : {1U, 3U, 4U, 5U}) pose_values_.push_back(number(cell));
  }

  void add_landmark() {
    expect_cells(4);
    check_count(landmarks_, "landmarks");
    landmark_names_.emplace(row_.cells[1]);
    landmarks_.names.emplace_back(row_.cells[1]);
    landmarks_.rows.push_back(row_.line);
    for (const std::size_t cell : {2U, 3U}) landmark_values_.push_back(number(cell));
  }

  Eigen::Index pose_named(std::string_view name) const {
    const auto found = pose_rows_.find(name);
    if (found == pose_rows_.end()) fail("no vertex before it is the pose " + in_quotes(name));
    return found->second;
  }

  void add_motion() {
    expect_cells(13);
    const Eigen::Index from = pose_named(row_.cells[2]);
    const Eigen::Index to = pose_named(row_.cells[3]);
    if (to != from + 1) fail("an edge between poses that do not follow each other");
    compare_stamp(from, to);
    const Step step{.line = row_.line,
                    .step = {number(4), number(6), number(5)},
                    .variances = {number(7), number(10), number(12)}};
    for (std::size_t cell = 7; cell < 13; ++cell) number(cell);
    if (!motions_by_pose_.emplace(to, step).second) fail("a second edge between the same poses");
  }

  void add_range() {
    expect_cells(6);
    const Eigen::Index pose = pose_named(row_.cells[2]);
    if (pose_rows_.contains(row_.cells[3])) fail("a range between two poses");
    if (!landmark_names_.contains(row_.cells[3]))
      fail("no vertex before it is the landmark " + in_quotes(row_.cells[3]));
    check_count(ranges_, "ranges");
    compare_stamp(pose, pose);
    variances_.push_back(std::max(0.0, number(5)));
    range_poses_.push_back(pose);
    ranges_.rows.push_back(row_.line);
    ranges_.names.emplace_back(row_.cells[3]);
    range_values_.push_back(time_s(pose));
    range_values_.push_back(number(4));
  }

  const std::string& source_;
  TableReader reader_;
  TableRow row_;
  std::string first_pose_;
  std::map<std::string, Eigen::Index, std::less<>> pose_rows_;
  std::set<std::string, std::less<>> landmark_names_;
  std::map<Eigen::Index, Step> motions_by_pose_;  ///< By the pose that they lead to.
  NumberTable poses_, motions_, ranges_, landmarks_;
  std::vector<double> pose_values_, range_values_, landmark_values_;
  std::vector<double> variances_;          ///< Of the ranges.
  std::vector<Eigen::Index> range_poses_;  ///< Where each range was measured.
  bool is_numbered_ = false;
  long long passed_over_ = 0;
  long long other_stamps_ = 0;
  double farthest_s_ = 0.0;
};

}  // namespace

RangeLog read_range_log_pyfg(ByteSource& source, const RangeLogOptions& options) {
  RangeLogParts parts{.source = source.name(), .name = options.name};
  const std::string bytes = source.rest();
  PyfgLines lines(checked_text(bytes, parts.source), parts.source);
  lines.read();
  parts.ground_truth = lines.ground_truth();
  parts.odometry = lines.motions();
  parts.measurements = lines.measurements();
  parts.true_landmarks = lines.landmarks();
  parts.remarks = lines.remarks();
  parts.start = {.time_s = parts.ground_truth->time_s(0),
                 .x_m = parts.ground_truth->positions_m(0, 0),
                 .y_m = parts.ground_truth->positions_m(0, 1),
                 .heading_rad = parts.ground_truth->heading_rad(0)};
  return assemble(std::move(parts), options);
}

}  // namespace mapproof
