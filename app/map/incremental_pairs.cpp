#include "app/map/incremental_pairs.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "app/map/data_association_words.hpp"
#include "app/map/known_so_far.hpp"
#include "app/map/range_bearing.hpp"
#include "core/align/rigid.hpp"
#include "core/follow/moved_watch.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/records/observations/detection_stream.hpp"

namespace mapproof {
namespace {

class PairFollower : public Follower {
 public:
  explicit PairFollower(const FollowedTable& table)
      : table_(table), stream_(table.source, {.unit = table.unit, .value = std::nullopt}) {}

  void take(std::string_view bytes) override { stream_.take(bytes); }
  void drop_half_line() override { stream_.drop_half_line(); }
  void end() override { stream_.end(); }
  long steps() const override { return scans_.steps(); }

  long take_steps() override {
    const std::vector<StreamedScan> scans = stream_.scans();
    for (const StreamedScan& scan : scans)
      scans_.add({scan.scan.robot, scan.scan.key}, scan.detections);
    return std::ssize(scans);
  }

  MapResult update() override {
    DetectionLog log = log_so_far();
    std::vector<std::string> remarks;
    if (table_.find_moved) {
      if (watch_.is_due(log.steps))
        for (const NoticedMove& move : watch_.check(scans_, log))
          remarks.push_back(
              fmt::format("After {} scans: {}.", log.steps, described(move.found, log)));
      log = watch_.split(scans_, std::move(log));
    }
    MapResult result = map_of(log);
    result.remarks = std::move(remarks);
    return result;
  }

  MapResult last_update() override {
    LabelOutcome outcome{.log = log_so_far()};
    if (table_.find_moved) {
      const auto M = static_cast<Eigen::Index>(outcome.log.names.size());
      const Points unknown = Points::Constant(M, 2, std::numeric_limits<double>::quiet_NaN());
      outcome = with_labels_checked(outcome.log, {.find_moved = true}, unknown);
    }
    MapResult result = map_of(outcome.log);
    result.labels = std::move(outcome.facts);
    for (const auto& more : {stream_.remarks(), outcome.remarks,
                             remarks_of_reference(result.record, table_.anchors, table_.truth)})
      result.remarks.insert(result.remarks.end(), more.begin(), more.end());
    return result;
  }

 private:
  DetectionLog log_so_far() const { return scans_.log(stream_.names(), stream_.is_timed()); }

  MapResult map_of(const DetectionLog& log) {
    MapResult result;
    MapRecord& record = result.record;
    record.id = "map";
    record.step = log.steps;
    record.names = log.names;
    result.read = {{"Detections", std::to_string(log.detections.size())}};
    describe_pairs(result, pair_map_of(log));
    const Reference known = known_so_far(record, table_.anchors, table_.truth);
    place_pairs(result, known, table_.fit, table_.rigid);
    if (known.anchors.empty() && !known.has_truth) lay_on_last(record);
    return result;
  }

  /// Turned and shifted, not mirrored: the scans tell which way round it is.
  void lay_on_last(MapRecord& record) {
    std::vector<Eigen::Index> here, there;
    for (std::size_t i = 0; i < record.names.size(); ++i) {
      // By name: second places of what moved stand behind all landmarks, of which there are more.
      const auto found = std::ranges::find(last_names_, record.names[i]);
      if (found == last_names_.end()) continue;
      const auto row = static_cast<Eigen::Index>(i);
      const Eigen::Index last = found - last_names_.begin();
      if (!record.estimate.row(row).allFinite() || !last_.row(last).allFinite()) continue;
      here.push_back(row);
      there.push_back(last);
    }
    if (here.size() >= 2)
      record.estimate = fit_similarity(record.estimate(here, Eigen::all), last_(there, Eigen::all),
                                       Alignment::kRigid)(record.estimate);
    last_ = record.estimate;
    last_names_ = record.names;
  }

  FollowedTable table_;
  DetectionStream stream_;
  IncrementalLog scans_;
  MovedWatch watch_;
  Points last_ = Points(0, 2);  ///< Without anchors and truth: the map before.
  std::vector<std::string> last_names_;
};

}  // namespace

std::unique_ptr<Follower> pair_follower(const FollowedTable& table) {
  return std::make_unique<PairFollower>(table);
}

}  // namespace mapproof
