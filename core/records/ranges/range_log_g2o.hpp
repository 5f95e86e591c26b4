#pragma once

#include <string>

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/ranges/gathered_range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// Whether a row begins as those of a graph of poses do: VERTEX_, EDGE_, FIX, PARAMS_.
bool names_graph_record(const TableRow& row);

/// Reads a g2o file of one robot: VERTEX_SE2 id x y theta, VERTEX_XY id x y, EDGE_SE2 a b dx dy
/// dtheta and the 6 numbers of its information, EDGE_RANGE_SE2_XY pose landmark range and its
/// information; information may be missing, in all edges of a kind or none. Vertices may stand
/// behind the edges that name them.
///
/// Poses are in the order of their vertices, one second apart, and each is joined to the next by an
/// edge. Positions of vertices are guesses, not used but for the start.
/// @throws IoError with the line.
RangeLogParts gather_g2o(ByteSource& source, const RangeLogOptions& options);

/// The path of the vertices VERTEX_SE2, as ground truth: one second apart. @throws IoError.
Trajectory read_g2o_path(ByteSource& source);

/// The positions of the vertices VERTEX_XY. @throws IoError.
NamedPoints read_g2o_landmarks(ByteSource& source);

/// A log with an estimate as g2o: path and landmarks as vertices, odometry and ranges as edges with
/// the information of their noise. Ranges are divided by the estimated scale and stand at the
/// nearest pose; landmarks are numbered behind the poses.
/// @param estimate      Its path has T poses for T - 1 motions.
/// @param motion_sigmas Forward, sideways, heading: of a motion without its own.
/// @param range_sigma_m Of a range without its own, > 0.
/// @throws InvalidInput if sizes do not agree or a sigma is not positive.
std::string range_log_g2o(const RangeLog& log, const SlamEstimate& estimate,
                          const Eigen::Vector3d& motion_sigmas, double range_sigma_m);

}  // namespace mapproof
