#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/model/paths/space_path.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// The errors of one method along a path.
struct PathErrorLine {
  std::string label;
  const PoseErrors* poses = nullptr;  ///< Not null, at least one pose.
  std::size_t series = 0;             ///< Its style, see series_style().
};

/// The errors of several methods in one run.
struct PathErrorsSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::vector<PathErrorLine> lines;
  std::vector<std::string> record_ids;
};

/// The aligned estimate of one of the methods as a line in the colours of its errors, and the
/// ground truth as a thin grey one. They are seen along the axis along which the ground truth
/// extends least. The figures of all methods have the same colours. Of more than 2000 poses those
/// with the greatest errors in 2000 equal pieces of the way are drawn.
/// @param shown  A row of `spec.lines`.
/// @throws InvalidInput if there is no such line, or one without poses.
Figure path_error_map_figure(const PathErrorsSpec& spec, std::size_t shown);

/// The errors of poses over time (over the number of the pose without times) and over the way.
/// Lines are thinned to their least and greatest values in 200 pieces, and broken where no pose is
/// associated for more than ten usual steps of time.
/// @throws InvalidInput as above.
Figure path_error_curves_figure(const PathErrorsSpec& spec);

/// The share of poses whose error is at or below a value: of positions and, where all methods have
/// it, of orientations.
/// @throws InvalidInput as above.
Figure path_error_distribution_figure(const PathErrorsSpec& spec);

/// What these figures show, as titles: "ORB errs by 9.8 mm (RMSE), 28 mm at most", "ORB has the
/// lowest RMSE, 9.8 mm; the next has 11 mm", and "half of the poses err by less than 7.9 mm with
/// ORB and 11 mm with rgbd".
/// @throws InvalidInput as above.
std::string path_error_finding(const PathErrorsSpec& spec, std::size_t shown);
std::string path_errors_finding(const PathErrorsSpec& spec);
std::string path_medians_finding(const PathErrorsSpec& spec);

}  // namespace mapproof
