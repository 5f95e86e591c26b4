#include "core/records/ranges/range_log_forms.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/json/text_input.hpp"
#include "core/records/ranges/range_tables.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kTumWidth = 8, kKittiWidth = 12;

std::size_t path_width(ByteSource& source) {
  std::size_t width = 0;
  first_row_is(
      source,
      [&](const TableRow& row) {
        if (std::ranges::all_of(row.cells, [](auto cell) { return number_in(cell).has_value(); }))
          width = row.cells.size();
        return true;
      },
      TableReader::kBlanks);
  return width;
}

/// @param poses  t x y z qx qy qz qw.
Eigen::MatrixXd tum_path(const Eigen::MatrixXd& poses) {
  const auto qx = poses.col(4).array(), qy = poses.col(5).array(), qz = poses.col(6).array(),
             qw = poses.col(7).array();
  const bool has_heading = (qx.abs() + qy.abs() + qz.abs()).maxCoeff() > 0.0;
  Eigen::MatrixXd path(poses.rows(), has_heading ? 4 : 3);
  path.leftCols(3) = poses.leftCols(3);
  for (Eigen::Index i = 0; has_heading && i < poses.rows(); ++i)
    path(i, 3) = std::atan2(2.0 * (qw(i) * qz(i) + qx(i) * qy(i)),
                            1.0 - 2.0 * (qy(i) * qy(i) + qz(i) * qz(i)));
  return path;
}

double spread(const Eigen::VectorXd& values) {
  return (values.array() - values.mean()).square().sum();
}

/// @param poses  r11 r12 r13 tx r21 r22 r23 ty r31 r32 r33 tz.
Eigen::MatrixXd kitti_path(const Eigen::MatrixXd& poses, const Eigen::VectorXd& times_s) {
  const bool is_camera = spread(poses.col(11)) > spread(poses.col(7));
  Eigen::MatrixXd path(poses.rows(), 4);
  path.col(0) = times_s;
  path.col(1) = is_camera ? Eigen::VectorXd(poses.col(11)) : Eigen::VectorXd(poses.col(3));
  path.col(2) = is_camera ? Eigen::VectorXd(-poses.col(3)) : Eigen::VectorXd(poses.col(7));
  for (Eigen::Index i = 0; i < poses.rows(); ++i)
    path(i, 3) =
        is_camera ? std::atan2(-poses(i, 2), poses(i, 10)) : std::atan2(poses(i, 4), poses(i, 0));
  return path;
}

/// Times next to a path of KITTI, one per row; empty if there are none.
Eigen::VectorXd times_beside(const ByteSource& source) {
  if (source.path().empty()) return {};
  const std::filesystem::path path = source.path().parent_path() / "times.txt";
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  ByteSource times(path);
  return read_number_table(times, 1).values.col(0);
}

}  // namespace

std::string_view path_form(ByteSource& source) {
  constexpr double kRounding = 1e-2;  // Of numbers with three digits.
  const auto is_unit = [](double square) { return std::abs(square - 1.0) < kRounding; };
  std::string_view form;
  const auto see = [&](const TableRow& row) {
    std::vector<double> numbers;
    for (const std::string_view cell : row.cells) numbers.push_back(number_in(cell).value_or(kNaN));
    const auto square = [&](std::size_t first, std::size_t count) {
      double sum = 0.0;
      for (std::size_t i = first; i < first + count; ++i) sum += numbers[i] * numbers[i];
      return sum;
    };
    if (numbers.size() == kTumWidth && is_unit(square(4, 4))) form = "TUM";
    if (numbers.size() == kKittiWidth && is_unit(square(0, 3)) && is_unit(square(4, 3)) &&
        is_unit(square(8, 3)))
      form = "KITTI";
    return true;
  };
  first_row_is(source, see, TableReader::kBlanks);
  return form;
}

bool is_path_text(ByteSource& source) {
  const std::size_t width = path_width(source);
  return width == kTumWidth || width == kKittiWidth;
}

Trajectory read_path_text(ByteSource& source, const Eigen::VectorXd& times_s) {
  const std::size_t width = path_width(source);
  Eigen::VectorXd times = width == kKittiWidth ? times_beside(source) : Eigen::VectorXd();
  if (times.size() == 0) times = times_s;
  NumberTable table = read_number_table(source, width);
  if (table.values.rows() == 0) throw IoError(table.source, "holds no poses");
  if (width == kTumWidth) {
    table.values = tum_path(table.values);
  } else if (times.size() == table.values.rows()) {
    table.values = kitti_path(table.values, times);
  } else {
    throw IoError(table.source,
                  fmt::format("is a KITTI path of {} poses without times: times.txt next to it is "
                              "missing or has another length, and the odometry has {} poses",
                              table.values.rows(), times_s.size()));
  }
  return trajectory_in(table);
}

}  // namespace mapproof
