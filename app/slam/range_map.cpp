#include "app/slam/range_map.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "app/map/map_folder.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/experiment/slam_run.hpp"
#include "core/records/studies/slam_store.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kEnoughKnown = 4;

std::vector<SlamMethod> methods_for(const RangeLog& log, bool knows) {
  std::vector<SlamMethod> methods;
  const bool moves = !log.odometry.empty();
  if (moves) methods = {SlamMethod::kDeadReckoning, SlamMethod::kEkf};
  if (knows) methods.push_back(SlamMethod::kSpectralKnown);
  if (knows && moves) methods.push_back(SlamMethod::kSpectralKnown7);
  methods.push_back(SlamMethod::kSpectral);
  if (moves)
    methods.insert(methods.end(), {SlamMethod::kSpectral7, SlamMethod::kBatchFixedScale,
                                   SlamMethod::kRefined, SlamMethod::kRefinedFromOdometry});
  return methods;
}

void remark_on_limits(const std::optional<KnownLandmarks>& known, RangeLog& log) {
  if (log.odometry.empty())
    log.remarks.push_back(
        "Without odometry, single measurements cannot be brought to common times: only times with "
        "a "
        "range to every landmark are used, nothing is refined, and unless four landmarks are known "
        "the reflection of the map fits as well as the map.");
  if (log.landmarks.size() < kEnoughKnown)
    log.remarks.push_back(fmt::format(
        "The spectral methods need {} landmarks; there {}.", kEnoughKnown,
        log.landmarks.size() == 1 ? "is 1" : fmt::format("are {}", log.landmarks.size())));
  if (known && known->rows.size() < kEnoughKnown)
    log.remarks.push_back(
        fmt::format("A map by known landmarks alone needs {}; {} known.", kEnoughKnown,
                    known->rows.size() == 1 ? "1 is" : fmt::format("{} are", known->rows.size())));
}

/// Over how many landmarks their errors are.
void remark_on_errors(const std::optional<KnownLandmarks>& known, RangeLog& log) {
  if (!log.true_landmarks || !known || known->rows.size() < 2) return;
  std::ptrdiff_t others = 0, given = 0;
  for (Eigen::Index n = 0; n < log.true_landmarks->rows(); ++n)
    if (log.true_landmarks->row(n).allFinite())
      ++(std::ranges::count(known->rows, n) > 0 ? given : others);
  if (given == 0) return;
  log.remarks.push_back(
      others == 0 ? std::string("Every landmark with ground truth is an anchor: there are no "
                                "errors of landmarks.")
                  : fmt::format("Errors of landmarks are means over {}: the {} with ground truth "
                                "{} left out.",
                                counted(others, "landmark"), counted(given, "anchor"),
                                given == 1 ? "is" : "are"));
}

bool has_map(const SlamRecord& record) {
  return record.estimate.path.size() > 0 &&
         (record.estimate.landmarks_m.array().isFinite().rowwise().all()).any();
}

const SlamRecord* of_method(const SlamRun& run, SlamMethod method) {
  for (const SlamRecord& record : run.records)
    if (record.method == method && has_map(record)) return &record;
  return nullptr;
}

/// What --repair came to.
void remark_on_repair(const SlamRun& run, std::vector<std::string>& remarks) {
  if (!run.fit || run.fit->verdict == FitVerdict::kNotTestable) return;
  const FitNumber* plain = run.fit->number("fit_held_out_nats");
  const FitNumber* repaired = run.fit->number("fit_repaired_held_out_nats");
  const bool is_made = of_method(run, SlamMethod::kRepaired) != nullptr;
  if (plain == nullptr || repaired == nullptr) {
    if (!is_made)
      remarks.push_back(
          "There is no repaired map: no cause was found for which a map can be corrected.");
    return;
  }
  remarks.push_back(fmt::format(
      "The map that allows for the cause predicts held-out ranges {}: mean log-likelihood {:.3f} "
      "instead of {:.3f} nats per range.",
      is_made ? "as well or better, and is the result" : "worse, and is not the result",
      repaired->value, plain->value));
}

/// How two results differ that are not the same one made twice; empty if they do not.
std::string difference(const SlamRun& there, const SlamRun& here) {
  const auto input = [](const SlamRun& run) {
    SlamRun bare;
    bare.id = run.id;
    bare.log = run.log;
    bare.log.remarks.clear();  // They are about what was done with it, too.
    return slam_run_json(bare);
  };
  if (there.log.landmarks != here.log.landmarks) return "of other landmarks";
  if (there.known != here.known) return "with other known landmarks";
  if (input(there) != input(here)) return "of another log";
  return "";
}

const fs::path& checked_slam_folder(const fs::path& folder) {
  check_result_folder(folder, kSlamFile, "range-only map");
  return folder;
}

}  // namespace

KnownLandmarks known_landmarks_of(const RangeLog& log, const NamedPointsFile& file) {
  const NamedPoints& points = file.points;
  KnownLandmarks known;
  for (std::size_t i = 0; i < points.names.size(); ++i) {
    const auto found = std::ranges::find(log.landmarks, points.names[i]);
    if (found == log.landmarks.end())
      throw IoError(file.path, points.locations[i],
                    fmt::format("landmark \"{}\" is not among the {} that were ranged to ({}){}",
                                printable(points.names[i]), log.landmarks.size(),
                                printable(listed(log.landmarks, 6), 200),
                                case_hint(points.names[i], log.landmarks)));
    known.rows.push_back(found - log.landmarks.begin());
  }
  known.positions_m = points.positions_m;
  return known;
}

SlamRunResult range_map(RangeLog log, const std::optional<KnownLandmarks>& known, LogFitOptions fit,
                        bool repairs) {
  remark_on_limits(known, log);
  remark_on_errors(known, log);
  const double unit = unit_of(log);
  std::optional<KnownLandmarks> scaled = known;
  if (scaled) scaled->positions_m /= unit;
  fit.known = scaled;
  fit.noise.range_m /= unit;
  fit.noise.way_m /= std::sqrt(unit);
  fit.noise.heading_per_metre *= std::sqrt(unit);
  const bool knows = known && known->rows.size() >= kEnoughKnown;
  const std::vector<SlamMethod> methods = methods_for(log, knows);
  SlamRunResult result = make_slam_run("own", in_unit(log, 1.0 / unit),
                                       {.methods = methods,
                                        .known = scaled,
                                        .ties_refinement = known && known->rows.size() >= 2,
                                        .fit = std::move(fit),
                                        .repairs = repairs});
  log.remarks = result.run.log.remarks;
  take_unit(result.run, std::move(log), unit);
  if (repairs) remark_on_repair(result.run, result.run.log.remarks);
  return result;
}

const SlamRecord* best_record(const SlamRun& run) {
  for (const SlamMethod method :
       {SlamMethod::kRepaired, SlamMethod::kRefined, SlamMethod::kRefinedFromOdometry,
        SlamMethod::kSpectralKnown, SlamMethod::kSpectral, SlamMethod::kEkf,
        SlamMethod::kDeadReckoning})
    if (const SlamRecord* record = of_method(run, method)) return record;
  return nullptr;
}

SlamFolder::SlamFolder(const fs::path& folder, const SlamRun& run)
    : folder_(checked_slam_folder(folder)) {
  refuse_links_out(folder);
  const fs::path file = folder / kSlamFile;
  std::error_code error;
  if (fs::exists(file, error)) {
    const std::string what = difference(parse_slam_run(read_file(file), file.string()), run);
    if (!what.empty())
      throw IoError(folder.string(),
                    fmt::format("holds another range-only map ({}); choose another --out or remove "
                                "it",
                                what));
  }
}

}  // namespace mapproof
