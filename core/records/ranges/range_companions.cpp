#include "core/records/ranges/range_companions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/ranges/range_columns.hpp"
#include "core/records/ranges/range_log_forms.hpp"
#include "core/records/ranges/range_log_g2o.hpp"
#include "core/records/ranges/range_tables.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

using Columns = std::vector<RangeColumn>;

const RangeColumn kPoseTime{ColumnRole::kTime, "times", {}};

const Columns& motion_columns() {
  static const Columns columns = {
      kPoseTime,
      {ColumnRole::kDistance, "distances", {"ddist", "distance", "dist", "weg", "strecke"}},
      {ColumnRole::kHeadingChange,
       "heading changes",
       {"dheading", "dtheta", "dyaw", "turn", "headingchange", "drehung"}},
      {ColumnRole::kSideways, "ways sideways", {"dside", "sideways"}, false}};
  return columns;
}

/// Time, x, y and heading.
Columns pose_columns(bool needs_heading) {
  return {kPoseTime,
          {ColumnRole::kX, "x", {kEastWords.begin(), kEastWords.end()}},
          {ColumnRole::kY, "y", {kNorthWords.begin(), kNorthWords.end()}},
          {ColumnRole::kHeading,
           "headings",
           {"heading", "theta", "yaw", "richtung", "kurs"},
           needs_heading}};
}

/// Whether the rows are records of a pose graph, as of g2o.
bool is_graph(ByteSource& source) {
  try {
    return first_row_is(source, names_graph_record, TableReader::kBlanks);
  } catch (const IoError&) {  // The reader of CSV reports what is wrong.
    return false;
  }
}

/// Reads a table in any form, see respell().
NumberTable read_table(ByteSource& source, const Columns& wanted, ColumnNames& columns) {
  mark_columns(source, columns);
  return read_range_columns(source, wanted, false, columns);
}

/// Whether a header names all the columns that are needed, and no landmarks.
bool names_columns(ByteSource& source, const Columns& wanted, const ColumnNames& columns) {
  return first_row_is(source, [&](const TableRow& row) {
    return missing_columns(row, wanted, columns).empty() &&
           missing_columns(row, {RangeColumn{ColumnRole::kLandmark, "", {}}}, columns).size() == 1;
  });
}

/// What a source, which stays unread, is by its first row; empty: none of them.
std::string companion_form(ByteSource& source, const ColumnNames& columns) {
  try {
    if (const std::string_view form = path_form(source); !form.empty()) return std::string(form);
    if (names_columns(source, motion_columns(), columns)) return "odometry";
    if (names_columns(source, pose_columns(false), columns)) return "CSV";
  } catch (const IoError&) {  // No text: other readers report what is wrong.
  }
  return "";
}

/// Along x and y.
Eigen::Vector2d extent(const Points& positions_m) {
  if (positions_m.rows() == 0) return {0.0, 0.0};
  return (positions_m.colwise().maxCoeff() - positions_m.colwise().minCoeff()).transpose();
}

/// Role and header of each column of positions; none without a header.
std::vector<std::pair<std::string, std::string>> position_columns(
    const std::vector<std::string>& first, const ColumnNames& columns) {
  const std::vector<std::string_view> header(first.begin(), first.end());
  const ColumnNames named = columns_in(header, columns);
  std::vector<std::pair<std::string, std::string>> found;
  for (std::size_t i = 0; i < header.size(); ++i) {
    std::optional<ColumnRole> role = column_heading(header[i], i, named).role;
    if (column_factor(header[i], ColumnRole::kX, kEastWords)) role = ColumnRole::kX;
    if (column_factor(header[i], ColumnRole::kY, kNorthWords)) role = ColumnRole::kY;
    if (role == ColumnRole::kLandmark || role == ColumnRole::kX || role == ColumnRole::kY)
      found.emplace_back(name(*role), first[i]);
  }
  return found;
}

CompanionSummary read_positions(ByteSource& source, const ColumnNames& columns) {
  CompanionSummary summary{.kind = "landmarks with positions", .companion = Companion::kLandmarks};
  ColumnNames named = columns;
  if (!is_graph(source)) {
    mark_columns(source, named);
    summary.columns = position_columns(first_row(source), columns);
  }
  const NamedPoints points = read_true_landmarks(source, named);
  summary.rows = points.positions_m.rows();
  summary.extent_m = extent(points.positions_m);
  if (!points.heights.empty()) summary.remarks.push_back(points.heights);
  return summary;
}

CompanionSummary path_summary(const Trajectory& path) {
  CompanionSummary summary{.kind = "path",
                           .companion = Companion::kPath,
                           .rows = path.size(),
                           .extent_m = extent(path.positions_m),
                           .has_headings = path.heading_rad.size() > 0};
  if (path.size() < 2) return summary;
  const Eigen::Index steps = path.size() - 1;
  summary.duration_s = path.time_s(steps) - path.time_s(0);
  summary.way_m =
      (path.positions_m.bottomRows(steps) - path.positions_m.topRows(steps)).rowwise().norm().sum();
  return summary;
}

CompanionSummary odometry_summary(const NumberTable& table) {
  const std::vector<Motion> motions = motions_in(table);
  CompanionSummary summary{.kind = "odometry of a range log, CSV",
                           .companion = Companion::kOdometry,
                           .rows = std::ssize(motions),
                           .columns = table.columns,
                           .remarks = odometry_remarks(motions)};
  if (motions.empty()) return summary;
  summary.duration_s = motions.back().time_s - motions.front().time_s;
  for (const Motion& motion : motions) {
    summary.way_m += std::hypot(motion.distance_m, motion.sideways_m);
    summary.turned_rad += std::abs(motion.heading_change_rad);
  }
  return summary;
}

}  // namespace

std::vector<Motion> read_motions(const fs::path& path, ColumnNames& columns) {
  ByteSource source(path);
  return motions_in(read_table(source, motion_columns(), columns));
}

StartPose read_start(const fs::path& path, ColumnNames& columns) {
  ByteSource source(path);
  const NumberTable table = read_table(source, pose_columns(true), columns);
  if (table.values.rows() != 1) throw IoError(table.source, "expected one row, that of the start");
  const Trajectory pose = trajectory_in(table);
  return {.time_s = pose.time_s(0),
          .x_m = pose.positions_m(0, 0),
          .y_m = pose.positions_m(0, 1),
          .heading_rad = pose.heading_rad(0)};
}

Trajectory read_true_path(ByteSource& source, const Eigen::VectorXd& times_s,
                          ColumnNames& columns) {
  if (is_path_text(source)) return read_path_text(source, times_s);
  if (is_graph(source)) return read_g2o_path(source);
  return trajectory_in(read_table(source, pose_columns(false), columns));
}

NamedPoints read_true_landmarks(ByteSource& source, ColumnNames& columns) {
  if (is_graph(source)) return read_g2o_landmarks(source);
  mark_columns(source, columns);
  return read_landmarks(source, columns);
}

void take_named_files(const RangeLogOptions& options, RangeLogParts& parts) {
  if (!options.odometry_file.empty()) {
    parts.odometry = read_motions(options.odometry_file, parts.columns);
    parts.start.reset();
  }
  if (!options.ground_truth_file.empty()) {
    ByteSource source(options.ground_truth_file);
    parts.ground_truth = read_true_path(source, pose_times(parts), parts.columns);
  }
  if (!options.landmarks_file.empty()) {
    ByteSource source(options.landmarks_file);
    parts.true_landmarks = read_true_landmarks(source, parts.columns);
  }
}

bool holds_landmarks(ByteSource& source, const ColumnNames& columns) {
  if (!path_form(source).empty()) return false;
  if (!is_graph(source)) respell(source);
  const std::vector<std::string> first = first_row(source);
  const std::vector<std::string_view> header(first.begin(), first.end());
  const ColumnNames named = columns_in(header, columns);
  const auto has = [&](ColumnRole role) {
    for (std::size_t i = 0; i < header.size(); ++i)
      if (column_heading(header[i], i, named).role == role) return true;
    return false;
  };
  if (has(ColumnRole::kLandmark)) return true;
  return !has(ColumnRole::kTime) && header.size() == 3;
}

CompanionSummary read_companion(ByteSource& source, Companion companion,
                                const ColumnNames& columns) {
  ColumnNames named = columns;
  if (companion == Companion::kLandmarks) return read_positions(source, columns);
  if (companion == Companion::kOdometry)
    return odometry_summary(read_table(source, motion_columns(), named));
  const std::string form(path_form(source));
  CompanionSummary summary;
  if (form == "KITTI") {
    // Its times are those of the odometry.
    summary.companion = Companion::kPath;
    summary.rows = read_number_table(source, 12).values.rows();
  } else if (is_path_text(source) || is_graph(source)) {
    summary = path_summary(read_true_path(source, {}, named));
  } else {
    const NumberTable table = read_table(source, pose_columns(false), named);
    summary = path_summary(trajectory_in(table));
    summary.columns = table.columns;
  }
  summary.kind = "path, " + (form.empty() ? "CSV" : form);
  return summary;
}

CompanionSummary read_companion(ByteSource& source, const ColumnNames& columns) {
  const std::string form = companion_form(source, columns);
  if (form.empty()) return {};
  return read_companion(source, form == "odometry" ? Companion::kOdometry : Companion::kPath,
                        columns);
}

}  // namespace mapproof
