#include "app/map/reference.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/align/diagonal_anchors.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/linalg/planarity.hpp"
#include "core/records/tables/respelling.hpp"

namespace mapproof {
namespace {

/// The row of each landmark by its name.
std::map<std::string, Eigen::Index> rows_of(const MappedLandmarks& source) {
  std::map<std::string, Eigen::Index> rows;
  for (std::size_t i = 0; i < source.names.size(); ++i)
    rows[source.names[i]] = static_cast<Eigen::Index>(i);
  return rows;
}

/// Positions by landmark, in the rows of the source; NaN where the file has none.
Points matched_ground_truth(const MappedLandmarks& source, const NamedPointsFile& ground_truth,
                            std::vector<std::string>& remarks) {
  const auto rows = rows_of(source);
  Points positions = Points::Constant(source.landmarks(), 2, kNaN);
  Eigen::Index matched = 0;
  for (std::size_t i = 0; i < ground_truth.points.names.size(); ++i) {
    const auto row = rows.find(ground_truth.points.names[i]);
    if (row == rows.end()) continue;
    positions.row(row->second) = ground_truth.points.positions_m.row(static_cast<Eigen::Index>(i));
    ++matched;
  }
  const auto given = std::ssize(ground_truth.points.names);
  if (matched == 0)
    throw IoError(ground_truth.path,
                  fmt::format("none of its {} names is a landmark of {} ({}, ...){}", given,
                              source.path, quoted_name(source.names.at(0)),
                              case_hint(ground_truth.points.names.at(0), source.names)));
  if (matched < given)
    remarks.push_back(fmt::format(
        "True positions of landmarks that were not observed, not used: {}.", given - matched));
  if (matched < source.landmarks())
    remarks.push_back(fmt::format("The true position of {} is not known.",
                                  counted(source.landmarks() - matched, "landmark")));
  return positions;
}

/// The anchors' rows, ascending; their positions go into `positions`.
std::vector<Eigen::Index> matched_anchors(const MappedLandmarks& source,
                                          const NamedPointsFile& anchors, Points& positions) {
  const auto rows = rows_of(source);
  std::vector<Eigen::Index> chosen;
  for (std::size_t i = 0; i < anchors.points.names.size(); ++i) {
    const std::string& name = anchors.points.names[i];
    const auto row = rows.find(name);
    if (row == rows.end())
      throw IoError(anchors.path, anchors.points.locations[i],
                    fmt::format("anchor {} is not among the {} landmarks of {} ({}, ...){}",
                                quoted_name(name), source.landmarks(), source.path,
                                quoted_name(source.names.at(0)), case_hint(name, source.names)));
    if (std::ranges::binary_search(source.unseen, row->second)) continue;
    positions.row(row->second) = anchors.points.positions_m.row(static_cast<Eigen::Index>(i));
    chosen.push_back(row->second);
  }
  if (chosen.size() < 3)
    throw IoError(anchors.path,
                  fmt::format("{} observed anchor{}; an affine map to the anchors needs 3 or more",
                              chosen.size(), chosen.size() == 1 ? "" : "s"));
  if (planarity(positions(chosen, Eigen::all)) <= kFlatPlanarity)
    throw IoError(
        anchors.path,
        fmt::format("its {} anchors lie on one line; they must span the plane", chosen.size()));
  std::ranges::sort(chosen);
  return chosen;
}

/// The anchors of a source that brings its ground truth, chosen among the landmarks that were
/// observed; none, with a remark, if they lie on one line.
std::vector<Eigen::Index> diagonal_anchors_of(const MappedLandmarks& source, Points positions_m,
                                              std::vector<std::string>& remarks) {
  for (const Eigen::Index row : source.unseen) positions_m.row(row).setConstant(kNaN);
  std::vector<Eigen::Index> anchors = diagonal_anchors(positions_m);
  if (planarity(positions_m(anchors, Eigen::all)) > kFlatPlanarity) return anchors;
  remarks.emplace_back("The observed landmarks lie on one line: none of them can be an anchor.");
  return {};
}

/// Anchors that stand elsewhere in the ground truth than in their own file.
void remark_disagreement(const Points& ground_truth_m, const Reference& known,
                         std::vector<std::string>& remarks) {
  const auto moved = std::ranges::count_if(known.anchors, [&](Eigen::Index row) {
    return (ground_truth_m.row(row) - known.positions_m.row(row)).norm() > 1e-6;
  });
  if (moved > 0)
    remarks.push_back(
        fmt::format("Anchors that the ground truth puts elsewhere: {}. The anchors' own "
                    "positions are used.",
                    moved));
}

/// Writes the positions of the landmarks that there are. @return Their rows, ascending.
std::vector<Eigen::Index> matched_so_far(const MapRecord& record, const NamedPoints& points,
                                         Points& positions_m) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < points.names.size(); ++i) {
    const auto found = std::ranges::find(record.names, points.names[i]);
    if (found == record.names.end()) continue;
    rows.push_back(found - record.names.begin());
    positions_m.row(rows.back()) = points.positions_m.row(static_cast<Eigen::Index>(i));
  }
  std::ranges::sort(rows);
  return rows;
}

std::vector<std::string> never_seen(const MapRecord& record, const NamedPoints& points) {
  std::vector<std::string> names;
  for (const std::string& name : points.names)
    if (std::ranges::find(record.names, name) == record.names.end()) names.push_back(name);
  return names;
}

}  // namespace

std::optional<NamedPointsFile> read_points(const std::string& path, ColumnNames& columns) {
  if (path.empty()) return std::nullopt;
  ByteSource source(path);
  mark_columns(source, columns);
  return NamedPointsFile{.path = input_name(path), .points = read_landmarks(source, columns)};
}

std::string quoted_name(const std::string& name) { return "\"" + printable(name) + "\""; }

std::string case_hint(const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::ranges::find_if(
      names, [&](const std::string& known) { return lower_case(known) == lower_case(name); });
  return found == names.end() ? "" : "; did you mean " + quoted_name(*found) + "?";
}

Reference reference_of(const MappedLandmarks& source, const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& ground_truth,
                       std::vector<std::string>& remarks) {
  Reference known{.positions_m = Points::Constant(source.landmarks(), 2, kNaN),
                  .has_ground_truth = ground_truth.has_value() || source.ground_truth_m.has_value(),
                  .anchors = {}};
  if (ground_truth) {
    known.positions_m = matched_ground_truth(source, *ground_truth, remarks);
  } else if (source.ground_truth_m) {
    known.positions_m = *source.ground_truth_m;
  }
  for (const auto* file : {&anchors, &ground_truth})
    if (*file && !(*file)->points.heights.empty()) remarks.push_back((*file)->points.heights);
  if (anchors) {
    const Points ground_truth_m = known.positions_m;
    known.anchors = matched_anchors(source, *anchors, known.positions_m);
    remark_disagreement(ground_truth_m, known, remarks);
  } else if (source.ground_truth_m) {
    known.anchors = diagonal_anchors_of(source, known.positions_m, remarks);
  }
  return known;
}

Reference known_so_far(MapRecord& record, const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& ground_truth) {
  const auto M = static_cast<Eigen::Index>(record.names.size());
  Reference known{
      .positions_m = Points::Constant(M, 2, kNaN), .has_ground_truth = false, .anchors = {}};
  if (ground_truth)
    known.has_ground_truth =
        !matched_so_far(record, ground_truth->points, known.positions_m).empty();
  if (!anchors) return known;
  known.anchors = matched_so_far(record, anchors->points, known.positions_m);
  std::erase_if(known.anchors,
                [&](Eigen::Index row) { return !record.estimate.row(row).allFinite(); });
  if (known.anchors.size() >= 3 &&
      planarity(known.positions_m(known.anchors, Eigen::all)) > kFlatPlanarity)
    return known;
  record.statuses.push_back(status_of<StatusReason::kFewAnchorsSoFar>(known.anchors.size()));
  known.anchors.clear();
  return known;
}

std::vector<std::string> remarks_of_reference(const MapRecord& record,
                                              const std::optional<NamedPointsFile>& anchors,
                                              const std::optional<NamedPointsFile>& ground_truth) {
  std::vector<std::string> remarks;
  const auto add = [&](const std::optional<NamedPointsFile>& file, const char* what) {
    if (!file) return;
    if (const auto names = never_seen(record, file->points); !names.empty())
      remarks.push_back(fmt::format("{} of landmarks that were not observed, not used: {}.", what,
                                    listed(names, 11)));
  };
  add(anchors, "Anchors");
  add(ground_truth, "True positions");
  if (!ground_truth) return remarks;
  const std::ptrdiff_t known =
      std::ssize(ground_truth->points.names) - std::ssize(never_seen(record, ground_truth->points));
  if (const std::ptrdiff_t left = std::ssize(record.names) - known; left > 0)
    remarks.push_back(
        fmt::format("The true position of {} is not known.", counted(left, "landmark")));
  return remarks;
}

}  // namespace mapproof
