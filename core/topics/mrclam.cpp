#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/align/diagonal_anchors.hpp"
#include "core/align/rigid.hpp"
#include "core/association/anchor_ids.hpp"
#include "core/association/association_check.hpp"
#include "core/association/shared_id.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/base/sha256.hpp"
#include "core/base/stopwatch.hpp"
#include "core/embed/embedder.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/linalg/planarity.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/points.hpp"
#include "core/observe/detected_proximities.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/records/detections/mrclam.hpp"
#include "core/statistics/intervals.hpp"
#include "core/topics/topic.hpp"
#include "core/topics/topics.hpp"
#include "core/uncertainty/pair_uncertainty.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Real scans some of whose landmark IDs were made wrong.
struct SpoiltIds {
  std::string id;  ///< "swapped", "misnamed".
  DetectionLog log;
};

/// The number of faults found, and the corrected log.
struct CorrectedIds {
  int faults = 0;
  DetectionLog log;
};

/// Landmarks, those of most detections first.
std::vector<int> by_detections(const DetectionLog& log) {
  std::vector<int> count(log.names.size(), 0);
  for (const Detection& seen : log.detections) ++count[static_cast<std::size_t>(seen.landmark)];
  std::vector<int> order(log.names.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&](int k) { return count[static_cast<std::size_t>(k)]; });
  return order;
}

DetectionLog swapped_in_half(DetectionLog log, int a, int b, std::uint64_t seed) {
  Random random(seed);
  std::vector<bool> is_wrong;
  for (int scan = 0; scan < log.steps; ++scan) is_wrong.push_back(random.uniform() < 0.5);
  for (Detection& seen : log.detections)
    if (is_wrong[static_cast<std::size_t>(seen.step)] && (seen.landmark == a || seen.landmark == b))
      seen.landmark = seen.landmark == a ? b : a;
  sort_detections(log.detections);
  return log;
}

/// @param log  Where both are in a scan, the misnamed detection is left out: an ID occurs once.
DetectionLog misnamed(DetectionLog log, int a, int b) {
  std::set<int> of_b;
  for (const Detection& seen : log.detections)
    if (seen.landmark == b) of_b.insert(seen.step);
  std::erase_if(log.detections, [&](const Detection& seen) {
    return seen.landmark == a && of_b.contains(seen.step);
  });
  for (Detection& seen : log.detections)
    if (seen.landmark == a) seen.landmark = b;
  sort_detections(log.detections);
  return log;
}

/// An ID swap in half of the scans, drawn at random; and one landmark called by another's name in
/// all of them. The landmarks are among those seen most, so that the fault has weight.
/// @return Empty for fewer than 6 landmarks.
std::vector<SpoiltIds> spoilt_ids(const DetectionLog& log, std::uint64_t seed) {
  const std::vector<int> order = by_detections(log);
  if (order.size() < 6) return {};
  return {{"swapped", swapped_in_half(log, order[1], order[4], seed)},
          {"misnamed", misnamed(log, order[5], order[2])}};
}

/// IDs that contradict one another, that two landmarks share, or that known positions contradict,
/// corrected as `mapproof map --repair-ids` does.
/// @param known_m  M x 2; empty: no position is known.
CorrectedIds corrected_log(const DetectionLog& log, const std::optional<Points>& known_m) {
  CorrectedIds corrected{.faults = 0, .log = log};
  const std::vector<Eigen::Index> unseen = unseen_in(log);
  if (unseen.size() == 1)
    if (const auto shared = shared_id(log)) {
      ++corrected.faults;
      corrected.log = split_id(log, *shared, static_cast<int>(unseen.front()));
    }
  AssociationCheck check = check_association(corrected.log);
  corrected.faults += static_cast<int>(check.findings.size());
  corrected.log = std::move(check.repaired);
  if (!known_m) return corrected;
  AnchorCheck positions = check_anchor_ids(corrected.log, *known_m);
  corrected.faults += static_cast<int>(positions.exchanges.size());
  corrected.log = std::move(positions.repaired);
  return corrected;
}

/// Files and folders in a folder, sorted. @throws IoError.
std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    paths.push_back(entry->path());
  if (error) throw IoError(folder.string(), "cannot be listed: " + error.message());
  std::ranges::sort(paths);
  return paths;
}

bool is_read(const std::string& name) {
  return name == "Barcodes.dat" || name == "Landmark_Groundtruth.dat" ||
         (name.starts_with("Robot") && name.ends_with("_Measurement.dat"));
}

/// Of the files that are read, in the order of their names.
std::string digest_of(const fs::path& folder) {
  std::string digests;
  for (const fs::path& path : entries_of(folder)) {
    const std::string name = unpacked_name(path.filename()).string();
    if (is_read(name)) digests += name + ' ' + sha256_hex(read_input(path)) + '\n';
  }
  return sha256_hex(digests);
}

/// A name as [a-z0-9-]+.
std::string id_of(const std::string& name) {
  std::string id;
  for (char c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (is_plain)
      id += c;
    else if (!id.empty() && id.back() != '-')
      id += '-';
  }
  while (id.ends_with('-')) id.pop_back();
  return id.empty() ? "set" : id;
}

DataSetFolder set_of(const fs::path& folder, const std::vector<DataSetFolder>& others) {
  const std::string name = fs::weakly_canonical(folder).filename().string();
  std::string id = id_of(name);
  for (int number = 2;
       std::ranges::any_of(others, [&](const DataSetFolder& other) { return other.set.id == id; });
       ++number)
    id = fmt::format("{}-{}", id_of(name), number);
  read_mrclam_detections(folder);  // A set that cannot be read is reported before anything is made.
  return {.set = {.id = id, .title = printable(name), .digest = digest_of(folder)},
          .folder = folder};
}

/// The MRCLAM sets in a folder, by id: its folders that hold a RobotN_Measurement.dat, or the
/// folder itself; each is read whole.
/// @throws IoError as read_mrclam_detections.
std::vector<DataSetFolder> mrclam_sets(const fs::path& folder) {
  if (is_mrclam(folder)) return {set_of(folder, {})};
  std::vector<DataSetFolder> sets;
  for (const fs::path& path : entries_of(folder)) {
    std::error_code error;
    if (fs::is_directory(path, error) && is_mrclam(path)) sets.push_back(set_of(path, sets));
  }
  std::ranges::sort(sets, {}, [](const DataSetFolder& data) { return data.set.id; });
  return sets;
}

constexpr AffineFit kFit = AffineFit::kLeastDistances;
constexpr int kFewestReplicates = 10;  ///< Of a bootstrap.
constexpr const char* kSetup = "sensors";
constexpr const char* kAssociation = "association";

/// Series of scans with wrong data association, as they are and corrected.
constexpr std::pair<const char*, const char*> kFaults[] = {
    {"swapped", "Two landmark IDs swapped in half of the scans"},
    {"swapped-corrected", "Correction of the swapped IDs"},
    {"misnamed", "One landmark with another's ID in all scans"},
    {"misnamed-corrected", "Correction of the wrong ID"}};

/// One strategy from a set's scans to a map.
struct MrclamMethod {
  const char* id;
  const char* label;
  Sensor sensor;                 ///< Of those that take one alone.
  std::optional<Method> method;  ///< Empty: of measured pairs.
  PairMapOptions pairs;
};

/// CMDS is what LPCA computes.
const MrclamMethod kMrclamMethods[] = {
    {"visibility-cmds", "Visibility, CMDS", Sensor::kVisibility, Method::kLpca, {}},
    {"visibility-isomap", "Visibility, ISOMAP", Sensor::kVisibility, Method::kIsomap, {}},
    {"bearing-cmds", "Bearing, CMDS", Sensor::kBearing, Method::kLpca, {}},
    {"bearing-isomap", "Bearing, ISOMAP", Sensor::kBearing, Method::kIsomap, {}},
    {"range-cmds", "Range, CMDS", Sensor::kRange, Method::kLpca, {}},
    {"range-isomap", "Range, ISOMAP", Sensor::kRange, Method::kIsomap, {}},
    {"paths", "Range and bearing, shortest paths", Sensor::kRange, {}, {.refined = false}},
    {"pairs-once", "Range and bearing, SMACOF once", Sensor::kRange, {}, {.reweightings = 0}},
    {"pairs", "Range and bearing, SMACOF reweighted", Sensor::kRange, {}, {}},
};

TopicDesign mrclam_design(const TopicExperiment&) {
  TopicDesign design;
  design.setups = {{kSetup, "A map per sensor and method"},
                   {kAssociation, "Range and bearing with wrong data association"}};
  for (const MrclamMethod& entry : kMrclamMethods)
    design.methods.push_back({entry.id, entry.label});
  for (const auto& [id, label] : kFaults) design.methods.push_back({id, label});
  design.quantities = {
      known_quantity("mpe_m"),
      known_quantity("moe_percent"),
      study_quantity("mpe_all_fitted_m", "MPE, affine map to all", "m", Better::kLower),
      study_quantity("rigid_m", "Error after a rigid fit to all", "m", Better::kLower),
      study_quantity("pair_m", "Error of pairs in the map (median)", "m", Better::kLower),
      study_quantity("mapped", "Landmarks mapped", "", Better::kHigher),
      study_quantity("faults", "Number of wrong data associations found", "", Better::kHigher)};
  return design;
}

/// A set as the strategies take it.
struct RealSet {
  DetectionSource source;
  std::vector<Eigen::Index> anchors;  ///< Empty: without ground truth, with too few usable anchors,
                                      ///< or no other landmark that could be scored.
};

std::vector<Eigen::Index> anchors_of(const DetectionSource& source) {
  if (!source.ground_truth_m) return {};
  Points known = Points::Constant(source.ground_truth_m->rows(), 2, kNaN);
  for (const Detection& seen : source.log.detections)
    known.row(seen.landmark) = source.ground_truth_m->row(seen.landmark);
  std::vector<Eigen::Index> anchors = diagonal_anchors(known);
  const auto others = known.col(0).array().isFinite().count() - std::ssize(anchors);
  if (anchors.size() < 3 || others == 0 || planarity(known(anchors, Eigen::all)) <= kFlatPlanarity)
    return {};
  return anchors;
}

/// Mean distance from the ground truth after the best rotation, reflection and translation.
double rigid_error(const Points& map, const Points& ground_truth_m) {
  std::vector<Eigen::Index> both;
  for (Eigen::Index i = 0; i < map.rows(); ++i)
    if (map.row(i).allFinite() && ground_truth_m.row(i).allFinite()) both.push_back(i);
  if (both.size() < 3) return kNaN;
  const Points from = map(both, Eigen::all);
  const Points to = ground_truth_m(both, Eigen::all);
  return (fit_similarity(from, to, Alignment::kRigidWithReflection)(from) - to)
      .rowwise()
      .norm()
      .mean();
}

double median_residual(const Points& map, const std::vector<MeasuredPair>& pairs) {
  std::vector<double> residuals;
  for (const MeasuredPair& pair : pairs)
    residuals.push_back(
        std::abs(pair.distance_m - (map.row(pair.first) - map.row(pair.second)).norm()));
  return residuals.empty() ? kNaN : median(residuals);
}

/// The map of a set by one strategy.
struct Made {
  Embedding embedding;
  std::vector<MeasuredPair> pairs;
  MethodSetting setting;
};

Made make_map(const MrclamMethod& entry, const RealSet& set, const TopicTask& context) {
  if (!entry.method) {
    PairMap map = pair_map_of(set.source.log, {}, entry.pairs);
    return {std::move(map.embedding), std::move(map.pairs), {Method::kSmacof, std::nullopt}};
  }
  MethodSetting setting{*entry.method, std::nullopt};
  if (on_graph(*entry.method)) setting.parameter = number_option(context.experiment, "neighbours");
  // Landmarks without a detection would only make the others' map fail.
  const auto landmarks = std::ssize(set.source.log.names);
  const std::vector<Eigen::Index> rows = other_rows(unseen_in(set.source.log), landmarks);
  Proximities all = detected_proximities(set.source.log, entry.sensor);
  all.inner_products = Eigen::MatrixXd(all.inner_products(rows, rows));
  all.squared_distances = Eigen::MatrixXd(all.squared_distances(rows, rows));
  const Embedding some = Embedder(std::move(all)).embed(setting);
  Made made{some, {}, setting};
  made.embedding.coordinates.setConstant(landmarks, 2, kNaN);
  made.embedding.coordinates(rows, Eigen::all) = some.coordinates;
  return made;
}

MapRecord record_of(const MrclamMethod& entry, const RealSet& set, const Made& made) {
  MapSource source{
      .id = entry.id,
      .origin = entry.method ? MapOrigin(FromSensor{entry.sensor, made.setting}) : FromPairs{},
      .step = set.source.log.steps,
      .names = set.source.log.names,
      .ground_truth_m = std::nullopt,
      .anchors = set.anchors};
  // Without anchors there is no frame in which the ground truth could be shown; the map of measured
  // pairs is in metres all the same.
  if (set.anchors.empty())
    return map_record(std::move(source),
                      {.positions_m = made.embedding.coordinates,
                       .frame = entry.method ? Frame::kSimilarity : Frame::kGroundTruth,
                       .statuses = made.embedding.statuses,
                       .score = std::nullopt});
  source.ground_truth_m = set.source.ground_truth_m;
  return map_record(std::move(source),
                    scored_map(made.embedding, *set.source.ground_truth_m, set.anchors, kFit));
}

/// @param outcome  Its setup and method are given.
TopicOutcome scored_outcome(TopicOutcome outcome, const MrclamMethod& entry, const RealSet& set,
                            const Made& made, const MapRecord& map) {
  const Points& own = made.embedding.coordinates;
  outcome.statuses = map.statuses;
  outcome.values["mapped"] =
      static_cast<double>((map.estimate.col(0).array() == map.estimate.col(0).array()).count());
  if (!set.anchors.empty()) {
    const Score score = map.score.value_or(Score{kNaN, kNaN, kNaN, kNaN});
    outcome.values["mpe_m"] = score.mpe_m;
    outcome.values["moe_percent"] = score.moe_percent;
    outcome.values["mpe_all_fitted_m"] = score.mpe_all_fitted_m;
  }
  if (entry.method) return outcome;
  outcome.values["pair_m"] = median_residual(own, made.pairs);
  if (set.source.ground_truth_m)
    outcome.values["rigid_m"] = rigid_error(own, *set.source.ground_truth_m);
  return outcome;
}

void add_entry(const MrclamMethod& entry, const RealSet& set, const TopicTask& context,
               TopicPart& part) {
  const Stopwatch stopwatch;
  const Made made = make_map(entry, set, context);
  part.seconds.push_back({context.part, entry.id, stopwatch.seconds()});
  TopicMap shown{.id = fmt::format("{}-{}", entry.id, context.part),
                 .at = condition(kSetup),
                 .method = entry.id,
                 .map = record_of(entry, set, made),
                 .pairs = made.pairs,
                 .uncertainty = {}};
  part.outcomes.push_back(
      scored_outcome({.at = condition(kSetup), .method = entry.id, .values = {}, .statuses = {}},
                     entry, set, made, shown.map));
  // The last strategy is the final one for pairs: its map shows them and its uncertainty.
  const bool is_last = &entry == &kMrclamMethods[std::size(kMrclamMethods) - 1];
  if (!is_last) shown.pairs.clear();
  const int replicates = static_cast<int>(number_option(context.experiment, "replicates"));
  if (is_last && replicates > 0)
    shown.uncertainty = pair_uncertainty(
        set.source.log,
        {set.anchors.empty() ? shown.map.estimate : *set.source.ground_truth_m, set.anchors,
         set.anchors.empty()},
        {.replicates = std::max(kFewestReplicates, replicates),
         .block = static_cast<Eigen::Index>(std::min<double>(
             number_option(context.experiment, "block_scans"), std::max(1, set.source.log.steps))),
         .seed = context.seed,
         .fit = kFit});
  if (context.with_maps) part.maps.push_back(std::move(shown));
}

/// The map of measured pairs of scans with wrong data association, as given and corrected.
void add_association(const RealSet& set, const TopicTask& context, TopicPart& part) {
  const MrclamMethod& entry = kMrclamMethods[std::size(kMrclamMethods) - 1];
  const auto add = [&](const std::string& method, const DetectionLog& log,
                       const Stopwatch& stopwatch) {
    RealSet other = set;
    other.source.log = log;
    const Made made = make_map(entry, other, context);
    part.seconds.push_back({context.part, method, stopwatch.seconds()});
    part.outcomes.push_back(scored_outcome(
        {.at = condition(kAssociation), .method = method, .values = {}, .statuses = {}}, entry,
        other, made, record_of(entry, other, made)));
  };
  for (const SpoiltIds& spoilt : spoilt_ids(set.source.log, context.seed)) {
    add(spoilt.id, spoilt.log, {});
    const Stopwatch stopwatch;
    const CorrectedIds corrected = corrected_log(spoilt.log, set.source.ground_truth_m);
    add(spoilt.id + "-corrected", corrected.log, stopwatch);
    part.outcomes.back().values["faults"] = corrected.faults;
  }
}

TopicPart make_mrclam(const TopicTask& context) {
  TopicPart part;
  RealSet set;
  set.source = read_mrclam_detections(context.data);
  set.anchors = anchors_of(set.source);
  for (const MrclamMethod& entry : kMrclamMethods) add_entry(entry, set, context, part);
  add_association(set, context, part);
  return part;
}

}  // namespace

const Topic kMrclamTopic = {
    .name = "mrclam",
    .of_data = true,
    .options = {{"neighbours", {5}, 1, 100, true, false},
                {"replicates", {200}, 0, 10'000, true, false},
                {"block_scans", {0}, 0, 100'000, true, false}},
    .design = mrclam_design,
    .make = make_mrclam,
    .data_sets = mrclam_sets,
};

}  // namespace mapproof
