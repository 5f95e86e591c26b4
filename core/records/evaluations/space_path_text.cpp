#include "core/records/evaluations/space_path_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/ranges/range_log_g2o.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kTumWidth = 8, kKittiWidth = 12, kEurocWidth = 8, kPositionWidth = 4;
constexpr double kLatest_s = 1e12;
/// KITTI's matrices have six digits.
constexpr double kRotationTolerance = 1e-3;

class PathReader {
 public:
  PathReader(std::string_view text, const std::string& source)
      : source_(source), separator_(TableReader::separator_in(text)),
        reader_(text, source, separator_) {}

  SpacePath read() {
    while (reader_.next(row_)) {
      if (row_.cells.front().starts_with('#')) continue;
      if (names_graph_record(row_)) is_graph_ = true;
      if (is_graph_)
        add_vertex();
      else
        add_row();
    }
    if (is_graph_)
      for (const auto& [id, pose] : vertices_) add(static_cast<double>(id), pose);
    if (times_s_.empty()) throw IoError(source_, "has no pose");
    return path();
  }

 private:
  struct Pose {
    Eigen::RowVector3d position_m;
    std::optional<Eigen::Matrix3d> orientation;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(source_, fmt::format("line {}", row_.line), what);
  }

  double number(std::size_t cell) const {
    const std::optional<double> value = number_in(row_.cells[cell]);
    if (!value || !std::isfinite(*value)) fail(number_problem(row_.cells[cell]));
    return *value;
  }

  Eigen::RowVector3d position(std::array<std::size_t, 3> cells) const {
    const Eigen::RowVector3d at(number(cells[0]), number(cells[1]), number(cells[2]));
    if (at.cwiseAbs().maxCoeff() > kFarthest_m)
      fail(fmt::format("a position is within {:g} m", kFarthest_m));
    return at;
  }

  /// @param first  The cell of x; `w` that of w.
  Eigen::Matrix3d orientation(std::size_t first, std::size_t w) const {
    const Eigen::Quaterniond q(number(w), number(first), number(first + 1), number(first + 2));
    if (!(q.norm() > 0.0) || !std::isfinite(q.squaredNorm()))
      fail("the quaternion is not an orientation: its length is 0 or not finite");
    return q.normalized().toRotationMatrix();
  }

  void add_row() {
    if (width_ == 0) choose_format();
    if (row_.cells.size() != width_)
      fail(fmt::format("has {} numbers, the first row has {}", row_.cells.size(), width_));
    if (separator_ == ',') {
      add_euroc();
    } else if (width_ == kTumWidth) {
      add(number(0), {position({1, 2, 3}), orientation(4, 7)});
    } else {
      add_kitti();
    }
  }

  void choose_format() {
    width_ = row_.cells.size();
    const bool is_known = separator_ == ','
                              ? width_ == kPositionWidth || width_ >= kEurocWidth
                              : width_ == kTumWidth || width_ == kKittiWidth;
    if (!is_known)
      fail(fmt::format("a path has 8 (TUM) or 12 (KITTI) numbers between blanks, or 8 and more "
                       "between commas (EuRoC); this row has {}",
                       width_));
    has_times_ = separator_ == ',' || width_ == kTumWidth;
  }

  void add_euroc() {
    constexpr double kPerSecond = 1e9;
    const double time_ns = number(0);
    if (time_ns != std::floor(time_ns))
      fail("EuRoC's times are whole nanoseconds; with seconds, write the path as TUM");
    Pose pose{position({1, 2, 3}), std::nullopt};
    if (width_ >= kEurocWidth) pose.orientation = orientation(5, 4);
    add(time_ns / kPerSecond, pose);
  }

  void add_kitti() {
    Eigen::Matrix3d R;
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index k = 0; k < 3; ++k) R(i, k) = number(static_cast<std::size_t>(4 * i + k));
    const Eigen::Matrix3d gap = R.transpose() * R - Eigen::Matrix3d::Identity();
    if (!(gap.cwiseAbs().maxCoeff() <= kRotationTolerance) || R.determinant() < 0.0)
      fail("columns 1 to 3, 5 to 7 and 9 to 11 are not a rotation");
    add(static_cast<double>(times_s_.size()), {position({3, 7, 11}), R});
  }

  void add_vertex() {
    const std::string_view kind = row_.cells[0];
    const bool is_in_space = kind == "VERTEX_SE3:QUAT";
    if (!is_in_space && kind != "VERTEX_SE2") return;
    const std::size_t width = is_in_space ? 9 : 5;
    if (row_.cells.size() != width)
      fail(fmt::format("{} has {} cells, expected {}", kind, row_.cells.size(), width));
    const double id = number(1);
    if (id != std::floor(id) || std::abs(id) > 1e15) fail("a vertex has a whole number");
    Pose pose{position(is_in_space ? std::array<std::size_t, 3>{2, 3, 4}
                                   : std::array<std::size_t, 3>{2, 3, 3}),
              std::nullopt};
    if (is_in_space) {
      pose.orientation = orientation(5, 8);
    } else {
      pose.position_m(2) = 0.0;
      pose.orientation =
          Eigen::AngleAxisd(number(4), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    }
    has_times_ = false;
    if (!vertices_.emplace(static_cast<long long>(id), pose).second)
      fail(fmt::format("the vertex {} is there twice", static_cast<long long>(id)));
  }

  void add(double time_s, const Pose& pose) {
    if (times_s_.size() >= static_cast<std::size_t>(kMostSteps))
      fail(fmt::format("more than {} poses", kMostSteps));
    if (std::abs(time_s) > kLatest_s)
      fail(fmt::format("a time is within {:g} s", kLatest_s));
    if (!times_s_.empty() && time_s < times_s_.back())
      fail("its time is before that of the pose above");
    times_s_.push_back(time_s);
    positions_m_.push_back(pose.position_m);
    if (pose.orientation) orientations_.push_back(*pose.orientation);
  }

  SpacePath path() const {
    SpacePath path{.time_s = Eigen::Map<const Eigen::VectorXd>(times_s_.data(),
                                                               std::ssize(times_s_)),
                   .positions_m = SpacePoints(std::ssize(positions_m_), 3),
                   .orientations = orientations_,
                   .has_times = has_times_};
    for (std::size_t i = 0; i < positions_m_.size(); ++i)
      path.positions_m.row(static_cast<Eigen::Index>(i)) = positions_m_[i];
    return path;
  }

  const std::string& source_;
  char separator_;
  TableReader reader_;
  TableRow row_;
  std::size_t width_ = 0;  ///< Of the first row; 0: not read yet.
  bool is_graph_ = false;
  bool has_times_ = true;
  std::map<long long, Pose> vertices_;
  std::vector<double> times_s_;
  std::vector<Eigen::RowVector3d> positions_m_;
  std::vector<Eigen::Matrix3d> orientations_;
};

}  // namespace

SpacePath read_space_path(ByteSource& source) {
  const std::string bytes = source.rest();
  return PathReader(checked_text(bytes, source.name()), source.name()).read();
}

}  // namespace mapproof
