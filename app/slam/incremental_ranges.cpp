#include "app/slam/incremental_ranges.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "app/map/known_so_far.hpp"
#include "app/map/range_bearing.hpp"
#include "core/align/aligned_to.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/words.hpp"
#include "core/range_slam/factors/online.hpp"
#include "core/records/observations/observation_stream.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kEnoughAnchors = 4;  // Landmarks, for a map by known ones.

class RangeFollower : public Follower {
 public:
  explicit RangeFollower(const FollowedTable& table)
      : table_(table), stream_(table.source, Sensor::kRange) {}

  void take(std::string_view bytes) override { stream_.take(bytes); }
  void drop_half_line() override { stream_.drop_half_line(); }
  void end() override { stream_.end(); }
  long steps() const override { return map_ ? static_cast<long>(map_->steps()) : 0; }

  long take_steps() override {
    const long before = steps();
    for (const StreamedStep& step : stream_.steps()) add(step);
    return steps() - before;
  }

  MapResult update() override {
    MapResult result;
    MapRecord& record = result.record;
    record.id = "map";
    record.origin = FromRanges{};
    record.step = static_cast<int>(steps());
    for (const Eigen::Index landmark : landmarks_)
      record.names.push_back(stream_.names()[static_cast<std::size_t>(landmark)]);
    record.estimate = Points::Zero(std::ssize(record.names), 2);
    const Reference known = known_so_far(record, table_.anchors, table_.truth);
    const SpectralMap map =
        known.anchors.size() >= kEnoughAnchors
            ? map_->map({known.anchors, known.positions_m(known.anchors, Eigen::all)})
            : map_->map();
    record.statuses.insert(record.statuses.end(), map.statuses.begin(), map.statuses.end());
    if (map.empty())
      record.estimate.setConstant(kNaN);
    else
      record.estimate = landmarks_of(map.C);
    if (map.empty()) return result;
    place_pairs(result, known, table_.fit, true);
    if (known.anchors.empty() && !known.has_truth) {
      if (last_)
        if (const auto laid = laid_rigidly_on(record.estimate, *last_)) record.estimate = *laid;
      last_ = record.estimate;
    }
    return result;
  }

  MapResult last_update() override {
    MapResult result = update();
    std::vector<std::string>& remarks = result.remarks;
    for (const std::string& remark : stream_.remarks()) remarks.push_back(remark);
    if (incomplete_ > 0)
      remarks.push_back(fmt::format("{} without a range to every landmark left out.",
                                    counted(incomplete_, "step")));
    std::vector<std::string> late;
    for (std::size_t i = 0; i < stream_.names().size(); ++i)
      if (column_of(static_cast<Eigen::Index>(i)) == std::ssize(landmarks_))
        late.push_back(stream_.names()[i]);
    if (!late.empty())
      remarks.push_back(fmt::format("Not on the map, as the first step has no range to them: {}.",
                                    listed(late, 11)));
    for (std::string& remark : remarks_of_reference(result.record, table_.anchors, table_.truth))
      remarks.push_back(std::move(remark));
    return result;
  }

 private:
  /// In the map; as many as it has for a landmark that it does not have.
  Eigen::Index column_of(Eigen::Index landmark) const {
    return std::ranges::find(landmarks_, landmark) - landmarks_.begin();
  }

  void add(const StreamedStep& step) {
    if (!map_) {
      if (step.values.empty()) return;
      for (const auto& [landmark, range_m] : step.values) landmarks_.push_back(landmark);
      std::ranges::sort(landmarks_);
      map_.emplace(std::ssize(landmarks_));
    }
    Eigen::VectorXd half_squares = Eigen::VectorXd::Constant(std::ssize(landmarks_), kNaN);
    for (const auto& [landmark, range_m] : step.values)
      if (const Eigen::Index column = column_of(landmark); column < half_squares.size())
        half_squares(column) = 0.5 * range_m * range_m;
    if (half_squares.allFinite())
      map_->add(half_squares);
    else
      ++incomplete_;
  }

  FollowedTable table_;
  ObservationStream stream_;
  std::vector<Eigen::Index> landmarks_;  ///< Of the stream's names, those of the first step.
  std::optional<OnlineSpectralMap> map_;
  std::size_t incomplete_ = 0;  ///< Steps that lack one of them.
  std::optional<Points> last_;  ///< Without anchors and truth: the map before.
};

}  // namespace

std::unique_ptr<Follower> range_follower(const FollowedTable& table) {
  return std::make_unique<RangeFollower>(table);
}

}  // namespace mapproof
