#include "app/follow_map.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "app/growing_file.hpp"
#include "core/align/laid_on.hpp"
#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/linalg/planarity.hpp"
#include "core/records/observation_stream.hpp"
#include "core/score/map_score.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::ptrdiff_t kMostFollowed = 2000;  ///< Landmarks, for the memory of their pairs.
constexpr double kWait_s = 0.2;                 ///< Between two looks at a file that does not grow.

/// The stream's steps as a map, and the map as a record.
class Follower {
 public:
  explicit Follower(const FollowOrder& order)
      : order_(order),
        stream_(order.path, order.sensor, order.unit),
        map_(order.sensor, order.options) {}

  ObservationStream& stream() { return stream_; }
  Eigen::Index steps() const { return map_.steps(); }

  /// Takes in the steps that are complete. @return How many.
  long take_steps() {
    const std::vector<StreamedStep> steps = stream_.steps();
    if (steps.empty()) return 0;
    if (std::ssize(stream_.names()) > kMostFollowed)
      throw IoError(order_.path, fmt::format("names more than {} landmarks; so many cannot be "
                                             "followed, only mapped as a whole",
                                             kMostFollowed));
    map_.grow(std::ssize(stream_.names()));
    for (const StreamedStep& step : steps) {
      std::vector<StepEntry> entries;
      for (const auto& [landmark, value] : step.values) entries.push_back({landmark, value});
      map_.add(entries);
    }
    return std::ssize(steps);
  }

  OwnMap update() {
    const FollowedUpdate update = map_.update();
    OwnMap result;
    MapRecord& record = result.record;
    record.id = "map";
    record.sensor = order_.sensor;
    record.setting = update.setting;
    record.step = static_cast<int>(map_.steps());
    record.names = stream_.names();
    record.names.resize(static_cast<std::size_t>(map_.landmarks()));
    record.frame = Frame::kSimilarity;
    record.estimate = update.embedding.coordinates;
    record.statuses = update.embedding.statuses;
    record.certificate = update.embedding.certificate;
    place(record);
    return result;
  }

 private:
  /// Into the frame of the anchors, or else near the map before.
  void place(MapRecord& record) {
    if (order_.anchors && fit(record)) return;
    if (last_.rows() > 0) {
      Points before = Points::Constant(record.estimate.rows(), 2, kUnknown);
      before.topRows(last_.rows()) = last_;
      if (const auto laid = laid_on(record.estimate, before)) record.estimate = *laid;
    }
    last_ = record.estimate;
  }

  bool fit(MapRecord& record) {
    const NamedPoints& points = order_.anchors->points;
    Points positions = Points::Constant(record.estimate.rows(), 2, kUnknown);
    for (std::size_t i = 0; i < points.names.size(); ++i) {
      const auto found = std::ranges::find(record.names, points.names[i]);
      if (found == record.names.end()) continue;
      const auto row = found - record.names.begin();
      positions.row(row) = points.positions_m.row(static_cast<Eigen::Index>(i));
      if (record.estimate.row(row).allFinite()) record.anchors.push_back(row);
    }
    std::ranges::sort(record.anchors);
    const bool spanning = record.anchors.size() >= 3 &&
                          planarity(positions(record.anchors, Eigen::all)) > kFlatPlanarity;
    if (!spanning) {
      record.statuses.push_back(
          {StatusCode::kAnchorsMissing,
           fmt::format("{} anchors are on the map so far, or lie on one line; an affine map needs "
                       "3 that span the plane.",
                       record.anchors.size())});
      record.anchors.clear();
      return false;
    }
    AlignedMap aligned = align_to_anchors(record.estimate, positions, record.anchors, order_.fit);
    record.statuses.insert(record.statuses.end(), aligned.statuses.begin(), aligned.statuses.end());
    if (!aligned.aligned) return false;
    record.frame = Frame::kTruth;
    record.estimate = std::move(aligned.positions_m);
    record.truth_m = positions;
    return true;
  }

  const FollowOrder& order_;
  ObservationStream stream_;
  FollowedMap map_;
  Points last_ = Points(0, 2);  ///< Without anchors: the map before.
};

/// Whether it is time for an update.
class Due {
 public:
  explicit Due(const FollowInterval& every) : every_(every) {}

  bool after(long steps) {
    steps_ += steps;
    if (steps_ == 0) return false;
    if (every_.steps > 0) return steps_ >= every_.steps;
    return std::chrono::duration<double>(Clock::now() - last_).count() >= every_.seconds;
  }

  void done() {
    steps_ = 0;
    last_ = Clock::now();
  }

 private:
  FollowInterval every_;
  long steps_ = 0;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

FollowInterval follow_interval(const std::string& text) {
  const bool seconds = text.ends_with('s');
  const auto number = number_in(std::string_view(text).substr(0, text.size() - (seconds ? 1 : 0)));
  const bool right =
      number && *number > 0.0 && *number <= 1e6 && (seconds || *number == std::floor(*number));
  if (!right)
    throw InvalidInput("--every: expected a number of steps, or of seconds as 2s, got " +
                       in_quotes(text));
  return seconds ? FollowInterval{.steps = 0, .seconds = *number}
                 : FollowInterval{.steps = static_cast<long>(*number), .seconds = 0.0};
}

OwnMap follow_map(const FollowOrder& order, const Console& console, const WriteFollowed& write) {
  const EndSignals signals;
  GrowingFile file(order.path);
  Follower follower(order);
  Due due(order.every);
  std::vector<std::string> remarks;
  std::string bytes;
  bool ended = false;
  while (!signals.asked()) {
    const GrowingFile::State state = file.read(bytes, kWait_s);
    ended = state == GrowingFile::State::kEnd;
    if (ended) break;
    if (state == GrowingFile::State::kReplaced) {
      remarks.push_back(file.name() +
                        " was cut short, removed or replaced: the map is that of what was read "
                        "before. Start again to follow the new file.");
      break;
    }
    follower.stream().take(bytes);
    if (!due.after(follower.take_steps())) continue;
    const OwnMap map = follower.update();
    write(map, false);
    console.detail(fmt::format("{} steps, {} landmarks", map.record.step, map.record.names.size()));
    due.done();
  }
  if (!ended) follower.stream().drop_half_line();
  follower.stream().end();
  follower.take_steps();
  if (follower.steps() == 0) throw IoError(file.name(), "held no observations");
  OwnMap last = follower.update();
  last.remarks = std::move(remarks);
  write(last, true);
  return last;
}

}  // namespace mapproof
