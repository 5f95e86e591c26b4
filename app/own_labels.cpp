#include "app/own_labels.hpp"

#include <limits>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "core/labels/mislabelled.hpp"
#include "core/labels/moved.hpp"
#include "core/records/mrclam.hpp"

namespace mapproof {
namespace {

void check(LabelOutcome& outcome, bool repair) {
  const LabelCheck check = check_labels(outcome.log);
  for (const LabelFinding& finding : check.findings)
    outcome.remarks.push_back(described(finding, outcome.log) + (repair ? "; repaired." : "."));
  if (check.findings.empty())
    outcome.remarks.push_back(fmt::format(
        "No label contradicts the others: loss {:.3f} m. A swap in all sightings would not show.",
        check.loss_before_m));
  else if (!repair)
    outcome.remarks.emplace_back("The labels are mapped as they are; --repair-labels mends them.");
  if (repair) outcome.log = check.repaired;
}

void split_moved(LabelOutcome& outcome) {
  const MovedCheck check = find_moved(outcome.log);
  for (const MovedLandmark& moved : check.moved)
    outcome.remarks.push_back(described(moved, outcome.log) + ".");
  if (check.moved.empty()) outcome.remarks.emplace_back("No landmark was found to have moved.");
  outcome.log = check.split;
}

}  // namespace

LabelOutcome with_labels_checked(const SightingLog& log, const LabelChoice& choice) {
  LabelOutcome outcome{log, {}};
  if (choice.check || choice.repair) check(outcome, choice.repair);
  if (choice.find_moved) split_moved(outcome);
  return outcome;
}

void check_labels_of(ObservationSource& source, const LabelChoice& choice) {
  if (!choice.asked()) return;
  if (!is_mrclam(source.path))
    throw IoError(source.path,
                  "labels are checked by range and bearing seen together, as a folder of MRCLAM "
                  "holds them");
  LabelOutcome outcome = with_labels_checked(read_mrclam_sightings(source.path).log, choice);
  source.history = history_of(outcome.log, source.history.sensor);
  source.remarks.insert(source.remarks.end(), outcome.remarks.begin(), outcome.remarks.end());
  const auto known = std::ssize(source.places);
  for (Eigen::Index k = known; k < source.history.landmarks(); ++k)
    source.places.push_back(source.places.empty() ? std::string() : source.places.front());
  if (!source.truth_m) return;
  // Where a landmark moved to, the survey does not say.
  Points truth_m =
      Points::Constant(source.history.landmarks(), 2, std::numeric_limits<double>::quiet_NaN());
  truth_m.topRows(source.truth_m->rows()) = *source.truth_m;
  source.truth_m = truth_m;
}

}  // namespace mapproof
