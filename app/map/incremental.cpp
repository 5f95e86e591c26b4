#include "app/map/incremental.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "app/map/id_check.hpp"
#include "app/map/scan_sizes.hpp"
#include "core/align/aligned_to.hpp"
#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/incremental/incremental_map.hpp"
#include "core/map_fit/map_fit.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/range_slam/factors/incremental_spectral_map.hpp"
#include "core/records/detections/detection_stream.hpp"
#include "core/records/observations/observation_stream.hpp"
#include "reports/sections/association_text.hpp"

namespace mapproof {
namespace {

/// Whether anything ties a map to a frame.
bool is_tied(const Reference& known) { return !known.anchors.empty() || known.has_ground_truth; }

/// The steps reference, align and score, of what is known of the landmarks so far.
/// @return Whether anything is known of them.
bool align_so_far(MapResult& result, const IncrementalTable& table) {
  const Reference known = known_so_far(result.record, table.anchors, table.ground_truth);
  align(result, known, table.fit);
  return is_tied(known);
}

/// The step explain: remarks on the files of anchors and ground truth in the end.
void explain_so_far(MapResult& result, const IncrementalTable& table) {
  for (std::string& remark : remarks_of_reference(result.record, table.anchors, table.ground_truth))
    result.remarks.push_back(std::move(remark));
}

/// Values of one sensor.
constexpr std::ptrdiff_t kMostIncremental = 2000;  ///< Landmarks, for the memory of their pairs.

class IncrementalValues : public IncrementalSource {
 public:
  explicit IncrementalValues(const IncrementalTable& table)
      : table_(table),
        stream_(table.source, table.sensor, table.format),
        map_(table.sensor, table.options) {}

  void take(std::string_view bytes) override { stream_.take(bytes); }
  void drop_half_line() override { stream_.drop_half_line(); }
  void end() override { stream_.end(); }
  long steps() const override { return map_.steps(); }

  long take_steps() override {
    const std::vector<StreamedStep> steps = stream_.steps();
    if (steps.empty()) return 0;
    if (std::ssize(stream_.names()) > kMostIncremental)
      throw IoError(table_.source, fmt::format("names more than {} landmarks, too many for an "
                                               "incremental map; map the whole file",
                                               kMostIncremental));
    map_.grow(std::ssize(stream_.names()));
    for (const StreamedStep& step : steps) {
      std::vector<StepEntry> entries;
      for (const auto& [landmark, value] : step.values) entries.push_back({landmark, value});
      map_.add(entries);
    }
    return std::ssize(steps);
  }

  MapResult update() override {
    const IncrementalUpdate update = map_.update();
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
    // An incremental map keeps no steps that could be compared with one another.
    result.fit = {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kNoiseModel}};
    align_so_far(result, table_);
    if (record.frame != Frame::kGroundTruth) align_to_last(record.estimate);
    return result;
  }

  MapResult last_update() override {
    MapResult result = update();
    result.remarks = stream_.remarks();
    explain_so_far(result, table_);
    return result;
  }

 private:
  void align_to_last(Points& estimate) {
    if (last_.rows() > 0) {
      Points before = Points::Constant(estimate.rows(), 2, kNaN);
      before.topRows(last_.rows()) = last_;
      if (const auto laid = aligned_to(estimate, before)) estimate = *laid;
    }
    last_ = estimate;
  }

  IncrementalTable table_;
  ObservationStream stream_;
  IncrementalMap map_;
  Points last_ = Points(0, 2);  ///< Without anchors: the map before.
};

/// Range and bearing.
class IncrementalPairs : public IncrementalSource {
 public:
  explicit IncrementalPairs(const IncrementalTable& table)
      : table_(table), stream_(table.source, table.format) {}

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
    AssociationOutcome outcome{.log = log_so_far()};
    if (table_.find_moved) {
      const auto M = static_cast<Eigen::Index>(outcome.log.names.size());
      outcome =
          with_association_checked(outcome.log, {.find_moved = true}, Points::Constant(M, 2, kNaN));
    }
    MapResult result = map_of(outcome.log);
    add_scan_sizes(scan_sizes(outcome.log), result);
    result.members.push_back({"data_association", association_json(outcome.facts)});
    for (const auto& more : {stream_.remarks(), outcome.remarks})
      result.remarks.insert(result.remarks.end(), more.begin(), more.end());
    explain_so_far(result, table_);
    return result;
  }

 private:
  DetectionLog log_so_far() const { return scans_.log(stream_.names(), stream_.is_timed()); }

  MapResult map_of(const DetectionLog& log) {
    MapResult result;
    MapRecord& record = result.record;
    record.id = "map";
    record.origin = FromPairs{};
    record.step = log.steps;
    record.names = log.names;
    const Embedding embedding = pair_map_of(log).embedding;
    record.estimate = embedding.coordinates;
    record.statuses = embedding.statuses;
    result.fit = fit_so_far(log, record);
    if (!align_so_far(result, table_)) align_to_last(record);
    return result;
  }

  /// Of the scans and of what is known of the landmarks so far; landmark IDs are not checked.
  Fit fit_so_far(const DetectionLog& log, MapRecord record) const {
    const Reference known = known_so_far(record, table_.anchors, table_.ground_truth);
    try {
      return range_bearing_fit(log, record.estimate, {.known_m = &known.positions_m});
    } catch (const InvalidInput&) {
      return {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kNoiseModel}};
    }
  }

  /// Rotated and translated, not reflected: the scans determine the reflection.
  void align_to_last(MapRecord& record) {
    std::vector<Eigen::Index> here, there;
    for (std::size_t i = 0; i < record.names.size(); ++i) {
      // By name: the second positions of moved landmarks stand behind all landmarks, and their
      // number grows.
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

  IncrementalTable table_;
  DetectionStream stream_;
  IncrementalLog scans_;
  MovedWatch watch_{MovedOptions{.is_contrasted = true}};
  Points last_ = Points(0, 2);  ///< Without anchors and ground truth: the map before.
  std::vector<std::string> last_names_;
};

constexpr std::size_t kEnoughAnchors = 4;  ///< Landmarks, for a map by known ones.

class IncrementalRanges : public IncrementalSource {
 public:
  explicit IncrementalRanges(const IncrementalTable& table)
      : table_(table), stream_(table.source, Sensor::kRange, table.format) {}

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
    result.fit = {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kOdometry}};
    record.step = static_cast<int>(steps());
    for (const Eigen::Index landmark : landmarks_)
      record.names.push_back(stream_.names()[static_cast<std::size_t>(landmark)]);
    record.estimate = Points::Zero(std::ssize(record.names), 2);
    const Reference known = known_so_far(record, table_.anchors, table_.ground_truth);
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
    align(result, known, table_.fit);
    if (!is_tied(known)) {
      if (last_)
        if (const auto laid = aligned_rigidly_to(record.estimate, *last_)) record.estimate = *laid;
      last_ = record.estimate;
    }
    return result;
  }

  MapResult last_update() override {
    MapResult result = update();
    std::vector<std::string>& remarks = result.remarks;
    for (const std::string& remark : stream_.remarks()) remarks.push_back(remark);
    if (incomplete_ > 0)
      remarks.push_back(fmt::format("{} without a range to every landmark: left out.",
                                    counted(incomplete_, "step")));
    std::vector<std::string> late;
    for (std::size_t i = 0; i < stream_.names().size(); ++i)
      if (column_of(static_cast<Eigen::Index>(i)) == std::ssize(landmarks_))
        late.push_back(stream_.names()[i]);
    if (!late.empty())
      remarks.push_back(fmt::format("Not on the map, as the first step has no range to them: {}.",
                                    listed(late, 11)));
    explain_so_far(result, table_);
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

  IncrementalTable table_;
  ObservationStream stream_;
  std::vector<Eigen::Index> landmarks_;  ///< Of the stream's names, those of the first step.
  std::optional<IncrementalSpectralMap> map_;
  std::size_t incomplete_ = 0;  ///< Steps that lack one of them.
  std::optional<Points> last_;  ///< Without anchors and ground truth: the map before.
};

}  // namespace

std::unique_ptr<IncrementalSource> incremental_values(const IncrementalTable& table) {
  return std::make_unique<IncrementalValues>(table);
}

std::unique_ptr<IncrementalSource> incremental_pairs(const IncrementalTable& table) {
  return std::make_unique<IncrementalPairs>(table);
}

std::unique_ptr<IncrementalSource> incremental_ranges(const IncrementalTable& table) {
  return std::make_unique<IncrementalRanges>(table);
}

}  // namespace mapproof
