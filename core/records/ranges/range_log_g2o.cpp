#include "core/records/ranges/range_log_g2o.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "core/base/angle.hpp"
#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"

namespace mapproof {
namespace {

/// Gathers the lines of a g2o file.
class G2oLines {
 public:
  G2oLines(std::string_view text, const std::string& source)
      : source_(source), reader_(text, source, TableReader::kBlanks) {
    for (NumberTable* table : {&poses_, &motions_, &ranges_, &landmarks_}) table->source = source;
  }

  void read() {
    while (reader_.next(row_)) take_row();
  }

  Trajectory path() const {
    if (poses_.rows.empty()) throw IoError(source_, "holds no pose (VERTEX_SE2)");
    return trajectory_in(filled(poses_, pose_values_, 4));
  }

  NamedPoints landmarks() const { return landmarks_in(filled(landmarks_, landmark_values_, 2)); }

  std::vector<Motion> motions() const {
    std::map<Eigen::Index, const Edge*> by_pose;
    for (const Edge& edge : edges_) {
      const Eigen::Index from = pose_of(edge.from, edge.line);
      const Eigen::Index to = pose_of(edge.to, edge.line);
      if (to != from + 1) fail_at(edge.line, "an edge between poses that do not follow each other");
      if (!by_pose.emplace(to, &edge).second)
        fail_at(edge.line, "a second edge between the same poses");
    }
    if (by_pose.size() + 1 != poses_.rows.size())
      throw IoError(source_, fmt::format("{} odometry edges for {} poses: one less is expected",
                                         by_pose.size(), poses_.rows.size()));
    NumberTable table = motions_;
    std::vector<double> values;
    for (const auto& [pose, edge] : by_pose) {
      table.rows.push_back(edge->line);
      for (const double value :
           {static_cast<double>(pose), edge->step(0), edge->step(2), edge->step(1)})
        values.push_back(value);
    }
    std::vector<Motion> motions = motions_in(filled(table, values, 4));
    std::size_t i = 0;
    for (const auto& [pose, edge] : by_pose) motions[i++].sigmas = edge->sigmas;
    return motions;
  }

  std::vector<NamedMeasurement> measurements() const {
    NumberTable table = ranges_;
    std::vector<double> values;
    for (const Range& range : measured_) {
      values.push_back(static_cast<double>(pose_of(range.pose, range.line)));
      values.push_back(range.range_m);
    }
    std::vector<NamedMeasurement> all = measurements_in(filled(table, values, 2));
    for (std::size_t i = 0; i < all.size(); ++i) all[i].sigma_m = measured_[i].sigma_m;
    return all;
  }

  std::vector<std::string> remarks() const {
    std::vector<std::string> remarks = {
        "The start is the first vertex, and a second is taken from each pose to the next."};
    if (passed_over_ > 0)
      remarks.push_back(
          fmt::format("{} passed over: fixed vertices, parameters and edges to "
                      "landmarks other than ranges.",
                      counted(passed_over_, "line")));
    return remarks;
  }

 private:
  struct Edge {
    std::size_t line;
    std::string from, to;
    Eigen::Vector3d step;  ///< Forward, left, heading change.
    std::optional<Eigen::Vector3d> sigmas;
  };
  struct Range {
    std::size_t line;
    std::string pose;
    double range_m, sigma_m;
  };

  static NumberTable filled(NumberTable table, const std::vector<double>& values,
                            Eigen::Index width) {
    table.set_values(values, width);
    return table;
  }

  [[noreturn]] void fail_at(std::size_t line, const std::string& what) const {
    throw IoError(source_, fmt::format("line {}", line), what);
  }
  [[noreturn]] void fail(const std::string& what) const { fail_at(row_.line, what); }

  double number(std::size_t cell) const {
    const std::optional<double> value = number_in(row_.cells[cell]);
    if (!value || !std::isfinite(*value)) fail(number_problem(row_.cells[cell]));
    return *value;
  }

  void expect_cells(std::size_t count, std::size_t or_count) const {
    if (row_.cells.size() != count && row_.cells.size() != or_count)
      fail(fmt::format("has {} cells, expected {}", row_.cells.size(), count));
  }

  void check_count(std::size_t count) const {
    if (count >= kMostSteps) fail(fmt::format("more than {} lines of one kind", kMostSteps));
  }

  void take_row() {
    const std::string_view kind = row_.cells[0];
    if (kind.starts_with("VERTEX_SE3") || kind.starts_with("VERTEX_TRACKXYZ") ||
        kind.starts_with("EDGE_SE3"))
      fail("is three-dimensional: " + in_quotes(kind) + "; maps are of the plane");
    if (kind == "VERTEX_SE2")
      add_pose();
    else if (kind == "VERTEX_XY")
      add_landmark();
    else if (kind == "EDGE_SE2")
      add_motion();
    else if (kind == "EDGE_RANGE_SE2_XY")
      add_range();
    else if (kind == "FIX" || kind == "EDGE_SE2_XY" || kind == "EDGE_PRIOR_SE2" ||
             kind.starts_with("PARAMS_") || kind.starts_with("#"))
      ++passed_over_;
    else
      fail("unknown record " + in_quotes(kind));
  }

  void add_pose() {
    expect_cells(5, 5);
    check_count(poses_.rows.size());
    const auto pose = static_cast<Eigen::Index>(poses_.rows.size());
    if (!rows_.emplace(row_.cells[1], pose).second)
      fail("pose " + in_quotes(row_.cells[1]) + " is there twice");
    poses_.rows.push_back(row_.line);
    pose_values_.push_back(static_cast<double>(pose));
    for (const std::size_t cell : {2U, 3U, 4U}) pose_values_.push_back(number(cell));
  }

  void add_landmark() {
    expect_cells(4, 4);
    check_count(landmarks_.rows.size());
    landmarks_.names.emplace_back(row_.cells[1]);
    landmarks_.rows.push_back(row_.line);
    for (const std::size_t cell : {2U, 3U}) landmark_values_.push_back(number(cell));
  }

  void add_motion() {
    expect_cells(12, 6);
    check_count(edges_.size());
    Edge edge{.line = row_.line,
              .from = std::string(row_.cells[1]),
              .to = std::string(row_.cells[2]),
              .step = {number(3), number(4), number(5)},
              .sigmas = std::nullopt};
    if (row_.cells.size() == 12) {
      Eigen::Matrix3d information;
      information << number(6), number(7), number(8), number(7), number(9), number(10), number(8),
          number(10), number(11);
      const Eigen::LLT<Eigen::Matrix3d> factor(information);
      if (factor.info() != Eigen::Success) fail("the information is not positive definite");
      const Eigen::Matrix3d covariance = factor.solve(Eigen::Matrix3d::Identity());
      edge.sigmas = covariance.diagonal().cwiseSqrt();
    }
    edges_.push_back(std::move(edge));
  }

  void add_range() {
    expect_cells(5, 4);
    check_count(measured_.size());
    double sigma_m = 0.0;
    if (row_.cells.size() == 5) {
      if (!(number(4) > 0.0)) fail("the information is not positive");
      sigma_m = 1.0 / std::sqrt(number(4));
    }
    ranges_.rows.push_back(row_.line);
    ranges_.names.emplace_back(row_.cells[2]);
    measured_.push_back({.line = row_.line,
                         .pose = std::string(row_.cells[1]),
                         .range_m = number(3),
                         .sigma_m = sigma_m});
  }

  Eigen::Index pose_of(const std::string& name, std::size_t line) const {
    const auto found = rows_.find(name);
    if (found == rows_.end()) fail_at(line, "no vertex is the pose " + in_quotes(name));
    return found->second;
  }

  const std::string& source_;
  TableReader reader_;
  TableRow row_;
  std::map<std::string, Eigen::Index, std::less<>> rows_;  ///< Of poses, by name.
  std::vector<Edge> edges_;
  std::vector<Range> measured_;
  NumberTable poses_, motions_, ranges_, landmarks_;
  std::vector<double> pose_values_, landmark_values_;
  long long passed_over_ = 0;
};

G2oLines lines_of(std::string_view bytes, const std::string& name) {
  G2oLines lines(checked_text(bytes, name), name);
  lines.read();
  return lines;
}

}  // namespace

bool names_graph_record(const TableRow& row) {
  const std::string_view kind = row.cells[0];
  return kind.starts_with("VERTEX_") || kind.starts_with("EDGE_") || kind == "FIX" ||
         kind.starts_with("PARAMS_");
}

RangeLogParts gather_g2o(ByteSource& source, const RangeLogOptions& options) {
  RangeLogParts parts{.source = source.name(), .name = options.name};
  const std::string bytes = source.rest();
  const G2oLines lines = lines_of(bytes, parts.source);
  const Trajectory path = lines.path();
  parts.odometry = lines.motions();
  parts.measurements = lines.measurements();
  parts.remarks = lines.remarks();
  parts.start = {.time_s = 0.0,
                 .x_m = path.positions_m(0, 0),
                 .y_m = path.positions_m(0, 1),
                 .heading_rad = path.heading_rad(0)};
  return parts;
}

Trajectory read_g2o_path(ByteSource& source) {
  const std::string bytes = source.rest();
  return lines_of(bytes, source.name()).path();
}

NamedPoints read_g2o_landmarks(ByteSource& source) {
  const std::string bytes = source.rest();
  return lines_of(bytes, source.name()).landmarks();
}

std::string range_log_g2o(const RangeLog& log, const SlamEstimate& estimate,
                          const Eigen::Vector3d& motion_sigmas, double range_sigma_m) {
  const Trajectory& path = estimate.path;
  if (path.size() != std::ssize(log.odometry) + 1 || path.heading_rad.size() != path.size() ||
      estimate.landmarks_m.rows() != std::ssize(log.landmarks))
    throw InvalidInput("g2o: a path with a pose for each motion and landmarks are needed");
  if (!(motion_sigmas.array() > 0.0).all() || !(range_sigma_m > 0.0))
    throw InvalidInput("g2o: sigmas must be positive");
  std::string text;
  for (Eigen::Index i = 0; i < path.size(); ++i)
    text += fmt::format("VERTEX_SE2 {} {} {} {}\n", i, path.positions_m(i, 0),
                        path.positions_m(i, 1), wrapped(path.heading_rad(i)));
  const auto is_placed = [&](Eigen::Index n) { return estimate.landmarks_m.row(n).allFinite(); };
  for (Eigen::Index n = 0; n < estimate.landmarks_m.rows(); ++n)
    if (is_placed(n))
      text += fmt::format("VERTEX_XY {} {} {}\n", path.size() + n, estimate.landmarks_m(n, 0),
                          estimate.landmarks_m(n, 1));
  text += "FIX 0\n";
  for (std::size_t i = 0; i < log.odometry.size(); ++i) {
    const Motion& motion = log.odometry[i];
    const Eigen::Vector3d weight =
        motion.sigmas.value_or(motion_sigmas).array().square().inverse().matrix();
    text +=
        fmt::format("EDGE_SE2 {} {} {} {} {} {} 0 0 {} 0 {}\n", i, i + 1, motion.distance_m,
                    motion.sideways_m, motion.heading_change_rad, weight(0), weight(1), weight(2));
  }
  for (const RangeMeasurement& range : log.ranges) {
    if (!is_placed(range.landmark) || range.time_s < path.time_s(0) ||
        range.time_s > path.time_s(path.size() - 1))
      continue;
    auto after = std::lower_bound(path.time_s.begin(), path.time_s.end(), range.time_s) -
                 path.time_s.begin();
    if (after > 0 && range.time_s - path.time_s(after - 1) < path.time_s(after) - range.time_s)
      --after;
    const double sigma_m =
        (range.sigma_m > 0.0 ? range.sigma_m : range_sigma_m) / estimate.range_scale;
    text += fmt::format("EDGE_RANGE_SE2_XY {} {} {} {}\n", after, path.size() + range.landmark,
                        range.range_m / estimate.range_scale, 1.0 / (sigma_m * sigma_m));
  }
  return text;
}

}  // namespace mapproof
