#include "app/map/id_check.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/map/pipeline.hpp"
#include "app/result_json.hpp"
#include "core/association/held_out.hpp"
#include "core/association/shared_id.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/records/detections/mrclam.hpp"
#include "reports/sections/association_text.hpp"

namespace mapproof {
namespace {

/// Known positions may be missed by so many times the loss: on fault-free logs by less than the
/// loss.
constexpr double kMissed = 3.0;

std::string id_of(const DetectionLog& log, int landmark) {
  return log.names[static_cast<std::size_t>(landmark)];
}

/// The known positions of the source and the files, anchors first; NaN rows: unknown.
Points known_positions(const DetectionLog& log, const std::optional<Points>& given_m,
                       const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& ground_truth) {
  Points known_m = given_m ? *given_m : Points::Constant(std::ssize(log.names), 2, kNaN);
  for (const auto* file : {&ground_truth, &anchors}) {
    if (!file->has_value()) continue;
    const NamedPoints& points = (*file)->points;
    for (std::size_t k = 0; k < points.names.size(); ++k)
      if (const auto found = std::ranges::find(log.names, points.names[k]);
          found != log.names.end())
        known_m.row(found - log.names.begin()) = points.positions_m.row(static_cast<int>(k));
  }
  return known_m;
}

/// Adds the remarks and warnings of a check besides its findings.
void add_doubts(const AssociationCheck& check, bool repair, AssociationOutcome& outcome) {
  const DetectionLog& log = outcome.log;
  for (const AssociationFinding& finding : check.findings)
    if (finding.undetermined > 0 || finding.left_out > 0)
      outcome.remarks.push_back(undetermined_text(finding, log, repair));
  const AssociationDoubts& doubts = check.doubts;
  if (doubts.grave()) outcome.warnings.push_back(doubts_text(check, log));
  if (check.findings.empty()) outcome.remarks.push_back(nothing_found_text(check));
}

/// Finds landmark IDs that contradict one another. @return The log with these IDs corrected.
DetectionLog check_pairs(AssociationOutcome& outcome, bool repair) {
  AssociationCheck check = check_association(outcome.log);
  for (const AssociationFinding& finding : check.findings)
    outcome.facts.push_back({std::string(name(finding.fault)), id_of(outcome.log, finding.first),
                             id_of(outcome.log, finding.second), described(finding, outcome.log),
                             finding.loss_before_m, finding.loss_after_m, repair});
  add_doubts(check, repair, outcome);
  outcome.loss_m = check.loss_after_m;
  outcome.doubtful = shown_names(check.doubts.landmarks, outcome.log);
  DetectionLog repaired = std::move(check.repaired);
  if (!repair) outcome.check = std::move(check);
  return repaired;
}

/// Finds a landmark ID that two landmarks share. @return The log with an ID for each.
DetectionLog check_shared(AssociationOutcome& outcome, DetectionLog log, bool repair) {
  const std::optional<SharedId> shared = shared_id(log);
  if (!shared) return log;
  const std::vector<Eigen::Index> unseen = unseen_in(log);
  const std::string first = id_of(log, shared->id);
  std::string second;
  int row = static_cast<int>(log.names.size());
  if (unseen.size() == 1) {
    row = static_cast<int>(unseen.front());
    second = id_of(log, row);
  } else {
    log.names.push_back(first + " (second position)");
  }
  outcome.facts.push_back({"shared", first, second, described(*shared, first, second),
                           shared->loss_before_m, shared->loss_after_m, repair});
  if (shared->undetermined > 0)
    outcome.remarks.push_back(undetermined_text(*shared, first, repair));
  outcome.loss_m = shared->loss_after_m;
  return split_id(log, *shared, row);
}

/// Finds landmark IDs that contradict known positions throughout. @return The log with these
/// corrected.
DetectionLog check_paths(AssociationOutcome& outcome, const DetectionLog& log,
                         const Points& known_m, bool repair) {
  AnchorCheck check = check_anchor_ids(log, known_m);
  for (const AnchorExchange& exchange : check.exchanges)
    outcome.facts.push_back({"exchanged", id_of(log, exchange.first), id_of(log, exchange.second),
                             described(exchange, log), exchange.misfit_before_m,
                             exchange.misfit_after_m, repair});
  if (check.positions < kFewestKnownPositions)
    outcome.remarks.push_back(too_few_known_text());
  else if (check.exchanges.empty())
    outcome.remarks.push_back(no_exchange_text(check));
  if (check.positions >= kFewestKnownPositions && check.misfit_after_m > kMissed * outcome.loss_m)
    outcome.warnings.push_back(known_missed_text(check, outcome.loss_m, outcome.doubtful));
  return std::move(check.repaired);
}

/// Finds landmark IDs that contradict one another. If a landmark is never seen, a shared ID is
/// tried first: it is accepted if it leaves no other finding.
DetectionLog check_scans(AssociationOutcome& outcome, bool repair) {
  if (!unseen_in(outcome.log).empty()) {
    AssociationOutcome tried{.log = outcome.log};
    DetectionLog split = check_shared(tried, outcome.log, repair);
    if (!tried.facts.empty()) {
      AssociationOutcome after{.log = split};
      DetectionLog corrected = check_pairs(after, repair);
      if (after.facts.empty() && after.warnings.empty()) {
        outcome.facts = std::move(tried.facts);
        outcome.remarks = std::move(tried.remarks);
        outcome.loss_m = after.loss_m;
        return corrected;
      }
    }
  }
  return check_shared(outcome, check_pairs(outcome, repair), repair);
}

/// Whether corrected IDs predict held-out scans at least as well as the given ones. If not, they
/// stay as they are, and a warning says so.
bool keeps_repair(AssociationOutcome& outcome, const DetectionLog& corrected) {
  if (outcome.facts.empty()) return true;
  const HeldOutFit held_out = held_out_fit(outcome.log, corrected);
  if (held_out.is_better()) {
    if (held_out.pairs > 0) outcome.remarks.push_back(repair_kept_text(held_out));
    return true;
  }
  outcome.warnings.push_back(repair_dropped_text(held_out));
  for (AssociationFact& fact : outcome.facts) fact.repaired = false;
  return false;
}

void check_and_repair(AssociationOutcome& outcome, bool repair, const Points& known_m) {
  DetectionLog corrected = check_scans(outcome, repair);
  if (repair && !keeps_repair(outcome, corrected)) corrected = outcome.log;
  Points positions_shown_m = Points::Constant(std::ssize(corrected.names), 2, kNaN);
  positions_shown_m.topRows(known_m.rows()) = known_m;
  corrected = check_paths(outcome, corrected, positions_shown_m, repair);
  for (const AssociationFact& fact : outcome.facts)
    outcome.remarks.push_back(fact.sentence + (fact.repaired ? "; repaired." : "."));
  if (!outcome.facts.empty() && !repair)
    outcome.remarks.emplace_back(
        "The landmark IDs are used as they are; --repair-ids corrects them.");
  if (repair) outcome.log = std::move(corrected);
}

void split_moved(AssociationOutcome& outcome) {
  MovedCheck check = find_moved(outcome.log, {.is_contrasted = true});
  for (const MovedLandmark& moved : check.moved) {
    outcome.facts.push_back({"moved",
                             id_of(outcome.log, moved.landmark),
                             {},
                             described(moved, outcome.log),
                             moved.loss_before_m,
                             moved.loss_after_m,
                             false});
    outcome.remarks.push_back(outcome.facts.back().sentence + ".");
  }
  if (check.moved.empty()) outcome.remarks.emplace_back("No landmark was found to have moved.");
  outcome.log = std::move(check.split);
}

/// Checks the log of a source, and adds rows for the second positions of landmarks that moved,
/// whose ground truth is unknown. @return The log to be mapped.
template <typename Source>
DetectionLog checked_log(Source& source, const DetectionLog& log, const MapJob& job,
                         MapDraft& draft) {
  MapResult& result = draft.result;
  AssociationOutcome outcome = with_association_checked(
      log, {.check = job.check_ids, .repair = job.repair_ids, .find_moved = job.find_moved},
      known_positions(log, source.ground_truth_m, job.known_anchors, job.known_ground_truth));
  const std::size_t landmarks = outcome.log.names.size();
  source.locations.resize(landmarks,
                          source.locations.empty() ? std::string() : source.locations.front());
  if (source.ground_truth_m) {
    Points ground_truth_m = Points::Constant(static_cast<Eigen::Index>(landmarks), 2, kNaN);
    ground_truth_m.topRows(source.ground_truth_m->rows()) = *source.ground_truth_m;
    source.ground_truth_m = ground_truth_m;
  }
  result.remarks.insert(result.remarks.end(), outcome.remarks.begin(), outcome.remarks.end());
  result.warnings.insert(result.warnings.end(), outcome.warnings.begin(), outcome.warnings.end());
  result.members.push_back({"data_association", association_json(outcome.facts)});
  draft.association = std::move(outcome.check);
  return std::move(outcome.log);
}

/// The check needs range and bearing of the same scan. A map of one sensor can be checked only from
/// a folder of MRCLAM files, whose history is then made again.
MapDraft check_ids(MapDraft draft, const MapJob& job) {
  if (!job.judges_ids()) return draft;
  if (auto* scans = std::get_if<DetectionSource>(&draft.observed)) {
    scans->log = checked_log(*scans, scans->log, job, draft);
    return draft;
  }
  hold_array(draft);
  auto& source = std::get<ObservationSource>(draft.observed);
  if (!is_folder(source.path) || !is_mrclam(source.path))
    throw IoError(source.path,
                  fmt::format("{} by range and bearing of the same scan: detections mapped with "
                              "--sensor range-bearing, or a folder of MRCLAM files",
                              job.check_ids || job.repair_ids ? "landmark IDs are checked"
                                                              : "a landmark that moved is found"));
  const DetectionLog log = checked_log(source, read_mrclam_detections(source.path).log, job, draft);
  source.history = history_of(log, source.history.sensor);
  return draft;
}

}  // namespace

const MapStep kIdCheck{check_ids};

AssociationOutcome with_association_checked(const DetectionLog& log,
                                            const AssociationChoice& choice,
                                            const Points& known_m) {
  AssociationOutcome outcome{.log = log};
  const auto step = [&](const char* what, const auto& take) {
    AssociationOutcome tried = outcome;
    try {
      take(tried);
      outcome = std::move(tried);
    } catch (const InvalidInput& problem) {
      outcome.warnings.push_back(check_failed_text(what, problem.what()));
    }
  };
  if (choice.check || choice.repair)
    step("landmark IDs",
         [&](AssociationOutcome& tried) { check_and_repair(tried, choice.repair, known_m); });
  if (choice.find_moved) step("moved landmarks", split_moved);
  return outcome;
}

nlohmann::ordered_json association_json(const std::vector<AssociationFact>& facts) {
  nlohmann::ordered_json items = nlohmann::ordered_json::array();
  for (const AssociationFact& fact : facts)
    items.push_back({{"what", fact.what},
                     {"first", fact.first},
                     {"second", fact.second},
                     {"found", fact.sentence},
                     {"before_m", number_or_null(fact.before_m)},
                     {"after_m", number_or_null(fact.after_m)},
                     {"repaired", fact.repaired}});
  return items;
}

}  // namespace mapproof
