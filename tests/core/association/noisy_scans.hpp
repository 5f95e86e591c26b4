#pragma once

#include <cstdint>
#include <functional>

#include "core/model/detection_log.hpp"
#include "core/model/points.hpp"

namespace mapproof::test {

/// Scans of 5 x 3 landmarks about 2 m apart, each of the four nearest, with errors of 3 % of the
/// range and 1 degree.
DetectionLog noisy_scans(int scans, std::uint64_t seed);

/// The true positions of these landmarks.
Points noisy_landmarks();

/// Scans of these landmarks, each of the five nearest, with errors of 2 % of the range and 1
/// degree; one of them is at another position from a step on.
DetectionLog scans_with_move(int scans, int landmark, const Eigen::RowVector2d& by_m, int from);

/// The log with the IDs of two landmarks swapped in some steps.
DetectionLog swapped(DetectionLog log, int first, int second,
                     const std::function<bool(int)>& in_step);

/// The log with detections of one landmark under another's ID, unless that is in the same scan.
DetectionLog called(DetectionLog log, int landmark, int other,
                    const std::function<bool(int)>& in_step);

/// How many detections of `log` have another ID than in `ground truth`.
int wrong_ids(const DetectionLog& log, const DetectionLog& ground_truth);

}  // namespace mapproof::test
