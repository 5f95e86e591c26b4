#include "core/range_slam/factors/window_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/range_slam/factors/spread_rows.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kTurns = 5;
/// Blocks of held-out readings to a window.
constexpr double kBlocks = 6.0;
/// Lengths tried: down to 1/181 of all the time.
constexpr int kLengths = 16;
/// Coverage is judged on about this many of the times.
constexpr Eigen::Index kCoverageTimes = 500;
/// Held-out readings that no window tells beyond this share make a length unusable.
constexpr double kUntold = 0.02;

/// Sum of absolute errors over the readings told, and how many were and were not.
struct HeldOut {
  double error_m = 0.0;
  Eigen::Index told = 0;
  Eigen::Index untold = 0;
};

/// @param phase  Shifts the blocks, so that landmarks are not held out at the same times.
void hold_out(const LandmarkReadings& readings, Eigen::Index turn, Eigen::Index phase,
              const WindowOptions& options, double first_s, HeldOut& result) {
  std::vector<Eigen::Index> kept, out;
  for (Eigen::Index i = 0; i < readings.size(); ++i) {
    const double block = std::floor((readings.time_s(i) - first_s) * kBlocks / options.length_s);
    const bool is_out = std::fmod(block + static_cast<double>(phase), kTurns) == double(turn);
    (is_out ? out : kept).push_back(i);
  }
  const LandmarkReadings asked = readings.at(out);
  // Asked at all readings, so that the windows lie as they do for the whole.
  const Eigen::VectorXd half_squares =
      windowed_half_squares(readings.at(kept), readings.time_s, readings.positions_m, options);
  const double scale = options.range_scale;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double half_square = half_squares(out[i]);
    if (!std::isfinite(half_square)) {
      ++result.untold;
      continue;
    }
    const double range_m = scale * std::sqrt(std::max(0.0, 2.0 * half_square));
    result.error_m += std::abs(range_m - asked.range_m(static_cast<Eigen::Index>(i)));
    ++result.told;
  }
}

WindowTrial tried(const std::vector<LandmarkReadings>& readings, const Trajectory& path,
                  const Eigen::VectorXd& some_s, double length_s) {
  const double first_s = some_s(0), last_s = some_s(some_s.size() - 1);
  WindowOptions options{.length_s = length_s,
                        .range_scale = range_scale_of(readings, first_s, last_s, length_s)};
  HeldOut held_out;
  for (Eigen::Index n = 0; n < std::ssize(readings); ++n)
    for (Eigen::Index turn = 0; turn < kTurns; ++turn)
      hold_out(readings[static_cast<std::size_t>(n)], turn, n, options, first_s, held_out);
  const auto covered = windowed_ranges(readings, path, some_s, options).columns.size();
  const bool usable =
      held_out.told > 0 && double(held_out.untold) <= kUntold * double(held_out.told);
  return {.length_s = length_s,
          .range_scale = options.range_scale,
          .error_m = usable ? held_out.error_m / double(held_out.told)
                            : std::numeric_limits<double>::quiet_NaN(),
          .covered = double(covered) / double(some_s.size())};
}

}  // namespace

WindowSearch choose_window(const std::vector<LandmarkReadings>& readings, const Trajectory& path,
                           const Eigen::VectorXd& time_s) {
  if (time_s.size() < 2 || !(time_s(time_s.size() - 1) > time_s(0)))
    throw InvalidInput("windows need two times or more");
  const Eigen::VectorXd some_s = time_s(spread_rows(time_s.size(), kCoverageTimes));
  const double all_s = some_s(some_s.size() - 1) - some_s(0);
  WindowSearch search;
  search.options.length_s = all_s;
  const WindowTrial* best = nullptr;
  for (int i = 0; i < kLengths; ++i)
    search.trials.push_back(
        tried(readings, path, some_s, all_s * std::pow(std::numbers::sqrt2, -i)));
  for (const WindowTrial& trial : search.trials) {
    if (std::isnan(trial.error_m)) continue;
    if (best == nullptr || trial.covered > best->covered ||
        (trial.covered == best->covered && trial.error_m < best->error_m))
      best = &trial;
  }
  if (best == nullptr) {
    search.all_covered = false;
    return search;
  }
  search.options = {.length_s = best->length_s, .range_scale = best->range_scale};
  search.all_covered = best->covered == 1.0;
  return search;
}

WindowCurve summary(const WindowSearch& search) {
  WindowCurve curve;
  for (const WindowTrial& trial : search.trials) {
    curve.lengths_s.push_back(trial.length_s);
    curve.held_out_m.push_back(trial.error_m);
  }
  curve.chosen_s = search.options.length_s;
  return curve;
}

}  // namespace mapproof
