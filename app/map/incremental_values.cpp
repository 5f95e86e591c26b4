#include "app/map/incremental_values.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include "app/map/known_so_far.hpp"
#include "core/align/aligned_to.hpp"
#include "core/base/errors.hpp"
#include "core/records/observations/observation_stream.hpp"

namespace mapproof {
namespace {

constexpr std::ptrdiff_t kMostFollowed = 2000;  ///< Landmarks, for the memory of their pairs.

class ValueFollower : public Follower {
 public:
  explicit ValueFollower(const FollowedTable& table)
      : table_(table),
        stream_(table.source, table.sensor, table.unit),
        map_(table.sensor, table.options) {}

  void take(std::string_view bytes) override { stream_.take(bytes); }
  void drop_half_line() override { stream_.drop_half_line(); }
  void end() override { stream_.end(); }
  long steps() const override { return map_.steps(); }

  long take_steps() override {
    const std::vector<StreamedStep> steps = stream_.steps();
    if (steps.empty()) return 0;
    if (std::ssize(stream_.names()) > kMostFollowed)
      throw IoError(table_.source, fmt::format("names more than {} landmarks; so many cannot be "
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

  MapResult update() override {
    const FollowedUpdate update = map_.update();
    MapResult result;
    MapRecord& record = result.record;
    record.id = "map";
    record.origin = FromSensor{table_.sensor, update.setting};
    record.step = static_cast<int>(map_.steps());
    record.names = stream_.names();
    record.names.resize(static_cast<std::size_t>(map_.landmarks()));
    record.estimate = update.embedding.coordinates;
    record.statuses = update.embedding.statuses;
    record.certificate = update.embedding.certificate;
    const Reference known = known_so_far(record, table_.anchors, table_.truth);
    align_and_score(record, update.embedding.coordinates, known, table_.fit);
    if (record.frame != Frame::kTruth) lay_on_last(record.estimate);
    return result;
  }

  MapResult last_update() override {
    MapResult result = update();
    result.remarks = stream_.remarks();
    for (std::string& remark : remarks_of_reference(result.record, table_.anchors, table_.truth))
      result.remarks.push_back(std::move(remark));
    return result;
  }

 private:
  void lay_on_last(Points& estimate) {
    if (last_.rows() > 0) {
      Points before =
          Points::Constant(estimate.rows(), 2, std::numeric_limits<double>::quiet_NaN());
      before.topRows(last_.rows()) = last_;
      if (const auto laid = aligned_to(estimate, before)) estimate = *laid;
    }
    last_ = estimate;
  }

  FollowedTable table_;
  ObservationStream stream_;
  IncrementalMap map_;
  Points last_ = Points(0, 2);  ///< Without anchors: the map before.
};

}  // namespace

std::unique_ptr<Follower> value_follower(const FollowedTable& table) {
  return std::make_unique<ValueFollower>(table);
}

}  // namespace mapproof
