#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/experiment.hpp"
#include "core/model/map_record.hpp"
#include "core/records/observations/landmarks_csv.hpp"

namespace mapproof {

/// A name from a file, between quotation marks.
std::string quoted_name(const std::string& name);

/// "; did you mean "B1"?" for a name that is one of the names but for its case; else empty.
std::string case_hint(const std::string& name, const std::vector<std::string>& names);

/// Positions read from a file, with its name for messages.
struct NamedPointsFile {
  std::string path;
  NamedPoints points;
};

/// Reads the file; empty for an empty path.
/// @param columns  That the user names; those that the file has are marked. @throws IoError.
std::optional<NamedPointsFile> read_points(const std::string& path, ColumnNames& columns);

/// The landmarks that a person's observations are of.
struct MappedLandmarks {
  std::string path;  ///< Of the observations, for errors.
  std::vector<std::string> names;
  std::vector<Eigen::Index> unseen;      ///< Ascending; they cannot be anchors.
  std::optional<Points> ground_truth_m;  ///< If the observations bring it; NaN rows: unknown.

  Eigen::Index landmarks() const { return std::ssize(names); }
};

/// What is known of the landmarks' true positions.
struct Reference {
  Points positions_m;                 ///< M x 2; NaN rows: unknown.
  bool has_ground_truth = false;      ///< More than the anchors is known: errors can be computed.
  std::vector<Eigen::Index> anchors;  ///< Ascending; empty: the map stays a shape.
};

/// Matches anchors and ground truth to the landmarks. Observations that bring their own ground
/// truth are aligned, without `anchors`, to the four landmarks furthest out along the diagonals.
/// @throws IoError naming file and line for anchors that cannot serve (fewer than three, on one
///         line, unknown, unobserved), or a ground truth about other landmarks.
Reference reference_of(const MappedLandmarks& source, const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& ground_truth,
                       std::vector<std::string>& remarks);

/// The known positions of the landmarks that an incremental map holds so far. Anchors that are not
/// on it are left out, and all of them, with a status, while the others do not span the plane.
/// @param record  Names and estimate are read; statuses are added to.
Reference known_so_far(MapRecord& record, const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& ground_truth);

/// Remarks on the files in the end, one sentence each: names that never came, landmarks
/// whose ground truth is not known.
std::vector<std::string> remarks_of_reference(const MapRecord& record,
                                              const std::optional<NamedPointsFile>& anchors,
                                              const std::optional<NamedPointsFile>& ground_truth);

}  // namespace mapproof
