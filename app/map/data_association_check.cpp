#include "app/map/data_association_check.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/map/data_association_words.hpp"
#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/words.hpp"
#include "core/labels/shared_label.hpp"
#include "core/records/observations/mrclam.hpp"

namespace mapproof {
namespace {

/// Times the loss that known places may be missed by: on sound logs it is less than the loss.
constexpr double kMissed = 3.0;

std::string label(const DetectionLog& log, int landmark) {
  return log.names[static_cast<std::size_t>(landmark)];
}

/// The places that the source and the files know, anchors' own first; NaN rows: none does.
Points known_places(const DetectionLog& log, const std::optional<Points>& given_m,
                    const std::optional<NamedPointsFile>& anchors,
                    const std::optional<NamedPointsFile>& truth) {
  Points known_m = given_m ? *given_m : Points::Constant(std::ssize(log.names), 2, kNaN);
  for (const auto* file : {&truth, &anchors}) {
    if (!file->has_value()) continue;
    const NamedPoints& points = (*file)->points;
    for (std::size_t k = 0; k < points.names.size(); ++k)
      if (const auto found = std::ranges::find(log.names, points.names[k]);
          found != log.names.end())
        known_m.row(found - log.names.begin()) = points.positions_m.row(static_cast<int>(k));
  }
  return known_m;
}

std::vector<std::string> names_of(const std::vector<int>& landmarks, const DetectionLog& log) {
  std::vector<std::string> names;
  for (const int k : landmarks) names.push_back(printable(label(log, k)));
  return names;
}

/// What a search for wrong labels leaves to be said besides its findings.
void add_doubts(const LabelCheck& check, bool repair, LabelOutcome& outcome) {
  const DetectionLog& log = outcome.log;
  for (const LabelFinding& finding : check.findings)
    if (finding.untold > 0 || finding.left_out > 0)
      outcome.remarks.push_back(
          fmt::format("Of {} and {}, {} with nothing else in the scan cannot be told and {}stay as "
                      "they are; {} "
                      "fit neither landmark and {} left out.",
                      printable(label(log, finding.first)), printable(label(log, finding.second)),
                      counted(finding.untold, "detection"), repair ? "" : "would ",
                      finding.left_out, repair ? "are" : "would be"));
  const LabelDoubts& doubts = check.doubts;
  if (doubts.grave())
    outcome.warnings.push_back(fmt::format(
        "The scans do not fit one map{}: residual {:.3f} m against {:.3f} m of their own "
        "spread{}.",
        check.findings.empty() ? "" : ", what was found corrected", doubts.residual_m,
        doubts.spread_m,
        doubts.landmarks.empty()
            ? ""
            : "; most with landmarks " + listed(names_of(doubts.landmarks, log), 4)));
  if (check.findings.empty())
    outcome.remarks.push_back(fmt::format(
        "No two labels swapped, and none wrong, over a stretch or in single scans explain the "
        "looks clearly better: loss {:.3f} m.",
        check.loss_before_m));
}

/// Labels that contradict one another. @return The log without those contradictions.
DetectionLog check_pairs(LabelOutcome& outcome, bool repair) {
  LabelCheck check = check_labels(outcome.log);
  for (const LabelFinding& finding : check.findings)
    outcome.facts.push_back({std::string(name(finding.fault)), label(outcome.log, finding.first),
                             label(outcome.log, finding.second), described(finding, outcome.log),
                             finding.loss_before_m, finding.loss_after_m, repair});
  add_doubts(check, repair, outcome);
  outcome.loss_m = check.loss_after_m;
  outcome.doubtful = names_of(check.doubts.landmarks, outcome.log);
  return std::move(check.repaired);
}

/// A label that two landmarks bear. @return The log with two labels then.
DetectionLog check_shared(LabelOutcome& outcome, DetectionLog log, bool repair) {
  const std::optional<SharedLabel> shared = shared_label(log);
  if (!shared) return log;
  const std::vector<Eigen::Index> unseen = unseen_in(log);
  const std::string first = label(log, shared->label);
  std::string second;
  int row = static_cast<int>(log.names.size());
  if (unseen.size() == 1) {
    row = static_cast<int>(unseen.front());
    second = label(log, row);
  } else {
    log.names.push_back(first + " (second place)");
  }
  outcome.facts.push_back(
      {"shared", first, second,
       fmt::format(
           "{} stands at two places {:.2f} m apart ({} and {} detections): another landmark "
           "bears its label{}: loss {:.3f} -> {:.3f} m",
           printable(first), shared->apart_m, shared->first_detections, shared->second_detections,
           second.empty() ? "" : ", likely " + printable(second) + ", which none shows",
           shared->loss_before_m, shared->loss_after_m),
       shared->loss_before_m, shared->loss_after_m, repair});
  if (shared->untold > 0)
    outcome.remarks.push_back(fmt::format("Of {}, {} cannot be told and {} left out.",
                                          printable(first), counted(shared->untold, "detection"),
                                          repair ? "are" : "would be"));
  outcome.loss_m = shared->loss_after_m;
  return split_label(log, *shared, row);
}

/// Labels that contradict known places throughout. @return The log without that.
DetectionLog check_places(LabelOutcome& outcome, const DetectionLog& log, const Points& known_m,
                          bool repair) {
  AnchorCheck check = check_anchor_labels(log, known_m);
  for (const AnchorExchange& exchange : check.exchanges)
    outcome.facts.push_back({"exchanged", label(log, exchange.first), label(log, exchange.second),
                             described(exchange, log), exchange.misfit_before_m,
                             exchange.misfit_after_m, repair});
  if (check.places < kFewestKnownPlaces)
    outcome.remarks.push_back(
        fmt::format("An exchange of two labels in all detections would not show: that needs the "
                    "places of {} landmarks or more.",
                    kFewestKnownPlaces));
  else if (check.exchanges.empty())
    outcome.remarks.push_back(fmt::format(
        "No exchange of labels would fit the {} known places clearly better: missed by {:.3f} m.",
        check.places, check.misfit_before_m));
  if (check.places >= kFewestKnownPlaces && check.misfit_after_m > kMissed * outcome.loss_m)
    outcome.warnings.push_back(fmt::format(
        "Known places are missed by {:.3f} m, far more than the loss of {:.3f} m explains: labels "
        "may be wrong in a way that was not found{}.",
        check.misfit_after_m, outcome.loss_m,
        outcome.doubtful.empty() ? "" : "; most doubtful: " + listed(outcome.doubtful, 4)));
  return std::move(check.repaired);
}

/// Labels that contradict one another. Where a landmark is never seen, that another bears its label
/// is tried first: it is taken if it leaves nothing else to be found.
DetectionLog check_scans(LabelOutcome& outcome, bool repair) {
  if (!unseen_in(outcome.log).empty()) {
    LabelOutcome tried{.log = outcome.log};
    DetectionLog split = check_shared(tried, outcome.log, repair);
    if (!tried.facts.empty()) {
      LabelOutcome after{.log = split};
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

void check_and_repair(LabelOutcome& outcome, bool repair, const Points& known_m) {
  DetectionLog corrected = check_scans(outcome, repair);
  Points places_m = Points::Constant(std::ssize(corrected.names), 2, kNaN);
  places_m.topRows(known_m.rows()) = known_m;
  corrected = check_places(outcome, corrected, places_m, repair);
  for (const LabelFact& fact : outcome.facts)
    outcome.remarks.push_back(fact.sentence + (repair ? "; repaired." : "."));
  if (!outcome.facts.empty() && !repair)
    outcome.remarks.emplace_back("The labels are mapped as they are; --repair-ids corrects them.");
  if (repair) outcome.log = std::move(corrected);
}

void split_moved(LabelOutcome& outcome) {
  MovedCheck check = find_moved(outcome.log);
  for (const MovedLandmark& moved : check.moved) {
    outcome.facts.push_back({"moved",
                             label(outcome.log, moved.landmark),
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

/// Checks the log of a source, and makes room for the second places of what moved: where those
/// are, no survey says.
template <class Source>
LabelOutcome checked(Source& source, const DetectionLog& log, const LabelChoice& choice,
                     const std::optional<NamedPointsFile>& anchors,
                     const std::optional<NamedPointsFile>& truth) {
  LabelOutcome outcome =
      with_labels_checked(log, choice, known_places(log, source.truth_m, anchors, truth));
  source.remarks.insert(source.remarks.end(), outcome.remarks.begin(), outcome.remarks.end());
  const std::size_t landmarks = outcome.log.names.size();
  source.places.resize(landmarks, source.places.empty() ? std::string() : source.places.front());
  if (source.truth_m) {
    Points truth_m = Points::Constant(static_cast<Eigen::Index>(landmarks), 2, kNaN);
    truth_m.topRows(source.truth_m->rows()) = *source.truth_m;
    source.truth_m = truth_m;
  }
  return outcome;
}

}  // namespace

LabelOutcome with_labels_checked(const DetectionLog& log, const LabelChoice& choice,
                                 const Points& known_m) {
  LabelOutcome outcome{.log = log};
  if (choice.check || choice.repair) check_and_repair(outcome, choice.repair, known_m);
  if (choice.find_moved) split_moved(outcome);
  return outcome;
}

CheckedLabels check_labels_of(DetectionSource& source, const LabelChoice& choice,
                              const std::optional<NamedPointsFile>& anchors,
                              const std::optional<NamedPointsFile>& truth) {
  if (!choice.asked()) return {};
  LabelOutcome outcome = checked(source, source.log, choice, anchors, truth);
  source.log = std::move(outcome.log);
  return {std::move(outcome.facts), std::move(outcome.warnings)};
}

CheckedLabels check_labels_of(ObservationSource& source, const LabelChoice& choice,
                              const std::optional<NamedPointsFile>& anchors,
                              const std::optional<NamedPointsFile>& truth) {
  if (!choice.asked()) return {};
  if (!is_folder(source.path) || !is_mrclam(source.path))
    throw IoError(source.path,
                  fmt::format("{} by range and bearing seen together: detections mapped with "
                              "--sensor range-bearing, or a folder of MRCLAM",
                              choice.check || choice.repair ? "labels are checked"
                                                            : "a landmark that moved is found"));
  LabelOutcome outcome =
      checked(source, read_mrclam_detections(source.path).log, choice, anchors, truth);
  source.history = history_of(outcome.log, source.history.sensor);
  return {std::move(outcome.facts), std::move(outcome.warnings)};
}

}  // namespace mapproof
