#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/map/pipeline.hpp"
#include "core/association/correspondence.hpp"
#include "core/base/errors.hpp"
#include "core/base/text/csv.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kAssociationFile = "association.csv";

/// The landmark that a measurement was assigned to.
struct AssignedMeasurement {
  double step = 0.0;     ///< Number of the step, as the file has it, or the column from 0.
  std::size_t line = 0;  ///< Of the file; 0: not known.
  std::string given;     ///< The landmark ID in the file: "?" if it had none.
  std::string found;     ///< The landmark.
  double value = 0.0;    ///< As the history has it: rad, m, or 0 and 1.
  bool clear = false;    ///< No swap within its step would be nearly as likely.
};

/// The result of estimating data association.
struct EstimatedIds {
  std::vector<AssignedMeasurement>
      measurements;  ///< All without a landmark ID; of uncertain IDs, the reassigned.
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;
using Lines = Eigen::Array<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double kManyUnclear = 0.1;  ///< Share of measurements that causes a warning.

/// A history without missing data, whose doubtful entries hold measurements in any order.
struct Dealt {
  Mask doubtful;   ///< M x N.
  Lines measured;  ///< M x N: index of the unassociated measurement there; -1: none.
};

/// Puts the measurements without a landmark ID into the empty entries of their step.
Dealt deal(ObservationSource& source) {
  Eigen::MatrixXd& values = source.history.values;
  Dealt dealt{Mask::Constant(values.rows(), values.cols(), false),
              Lines::Constant(values.rows(), values.cols(), -1)};
  // With visibility, a file may list detections only: 0, not seen, is then as free as NaN.
  const bool is_seen =
      source.history.sensor == Sensor::kVisibility && !values.array().isNaN().any();
  for (std::size_t k = 0; k < source.unassociated.size(); ++k) {
    const UnassociatedMeasurement& measured = source.unassociated[k];
    Eigen::Index row = 0;
    while (row < values.rows() && !(dealt.measured(row, measured.step) < 0 &&
                                    (std::isnan(values(row, measured.step)) ||
                                     (is_seen && values(row, measured.step) == 0))))
      ++row;
    if (row == values.rows())
      throw IoError(source.path, fmt::format("line {}", measured.line),
                    fmt::format("step {:.0f} has more measurements without a landmark ID than "
                                "landmarks without a measurement",
                                measured.number));
    values(row, measured.step) = measured.value;
    dealt.measured(row, measured.step) = static_cast<Eigen::Index>(k);
    dealt.doubtful(row, measured.step) = true;
  }
  if (is_seen)
    for (const UnassociatedMeasurement& measured : source.unassociated)
      for (Eigen::Index row = 0; row < values.rows(); ++row)
        if (values(row, measured.step) == 0.0) dealt.doubtful(row, measured.step) = true;
  return dealt;
}

void require_complete(const ObservationSource& source) {
  const ObservationHistory& history = source.history;
  for (Eigen::Index step = 0; step < history.steps(); ++step)
    for (Eigen::Index row = 0; row < history.landmarks(); ++row)
      if (std::isnan(history.values(row, step)))
        throw IoError(
            source.path,
            fmt::format("data association needs a measurement of every landmark at every step, "
                        "with a landmark ID or without; step {} (of {}) has none left for \"{}\"",
                        step + 1, history.steps(),
                        printable(history.names[static_cast<std::size_t>(row)])));
}

void mark_uncertain(const ObservationSource& source, const std::vector<std::string>& uncertain,
                    Mask& doubtful) {
  if (uncertain.size() == 1)
    throw IoError(source.path,
                  "one uncertain landmark ID cannot be confused with another; name two or more");
  for (const std::string& id : uncertain) {
    const auto row = std::ranges::find(source.history.names, id);
    if (row == source.history.names.end())
      throw IoError(source.path, fmt::format("no landmark is named \"{}\"", printable(id)));
    doubtful.row(row - source.history.names.begin()).setConstant(true);
  }
}

/// The measurements without a landmark ID, and those assigned to another landmark than in the file.
std::vector<AssignedMeasurement> assigned(const ObservationSource& source, const Dealt& dealt,
                                          const Correspondence& found) {
  std::vector<AssignedMeasurement> measurements;
  for (Eigen::Index step = 0; step < source.history.steps(); ++step)
    for (Eigen::Index row = 0; row < source.history.landmarks(); ++row) {
      const Eigen::Index from = found.measurement_of(row, step);
      const Eigen::Index unassociated = dealt.measured(from, step);
      const double value = found.history.values(row, step);
      // Where nothing was seen there is no measurement to assign to another landmark.
      const bool is_reading = source.history.sensor != Sensor::kVisibility || value != 0.0;
      if (unassociated < 0 && (from == row || !is_reading)) continue;
      AssignedMeasurement one{.step = static_cast<double>(step),
                              .line = 0,
                              .given = source.history.names[static_cast<std::size_t>(from)],
                              .found = source.history.names[static_cast<std::size_t>(row)],
                              .value = value,
                              .clear = found.clear(row, step)};
      if (unassociated >= 0) {
        const UnassociatedMeasurement& measured =
            source.unassociated[static_cast<std::size_t>(unassociated)];
        one.step = measured.number, one.line = measured.line, one.given = kUnassociatedMark;
      }
      measurements.push_back(std::move(one));
    }
  return measurements;
}

/// Landmarks that are doubtful at every step: no measurement distinguishes them at the start.
std::vector<std::string> never_certain(const ObservationSource& source, const Mask& doubtful) {
  std::vector<std::string> names;
  for (Eigen::Index row = 0; row < doubtful.rows(); ++row)
    if (doubtful.row(row).all())
      names.push_back(printable(source.history.names[static_cast<std::size_t>(row)]));
  return names;
}

void report(const ObservationSource& source, const Mask& doubtful, const Correspondence& found,
            EstimatedIds& ids) {
  const auto all = doubtful.count();
  const auto clear = (found.clear && doubtful).count();
  const double unclear = 1.0 - static_cast<double>(clear) / static_cast<double>(all);
  ids.remarks.push_back(fmt::format(
      "Data association estimated together with the map: {} uncertain, {:.1f} % of them resolved "
      "clearly; {} without a landmark ID, or assigned to another landmark than given "
      "(association.csv). "
      "The share of the variance that LPCA leaves unexplained fell from {:.4f} to {:.4f}.",
      counted(all, "measurement"), 100.0 * (1.0 - unclear),
      counted(std::ssize(ids.measurements), "measurement"), found.loss_before, found.loss_after));
  if (!found.converged)
    ids.warnings.push_back(fmt::format(
        "Data association still changed after {} rounds: it has not converged.", found.rounds));
  if (unclear > kManyUnclear)
    ids.warnings.push_back(fmt::format(
        "{:.0f} % of the uncertain measurements would fit another landmark nearly as well.",
        100.0 * unclear));
  if (const std::vector<std::string> names = never_certain(source, doubtful); names.size() > 1)
    ids.warnings.push_back(fmt::format(
        "{} have no certain measurement: their data association follows the landmark IDs as given, "
        "and is undetermined where those are wrong about as often as right.",
        listed(names, 10)));
}

/// Estimates, together with the map, the data association of measurements without a landmark ID and
/// of uncertain IDs (see estimated_correspondence), and reorders the history accordingly.
/// @param uncertain  Landmark IDs whose measurements may belong to any of the others; empty: none.
/// @throws IoError naming the line or the step for what cannot be estimated: an entry that is
///         missing though there is no measurement for it, more measurements than free landmarks,
///         an ID that is not there; or for a single uncertain ID.
EstimatedIds estimate_ids(ObservationSource& source, const std::vector<std::string>& uncertain) {
  EstimatedIds ids;
  Dealt dealt = deal(source);
  require_complete(source);
  if (source.history.landmarks() < 3)
    throw IoError(source.path,
                  "data association needs three landmarks whose IDs some measurements have");
  mark_uncertain(source, uncertain, dealt.doubtful);
  const Correspondence found = estimated_correspondence(source.history, dealt.doubtful);
  ids.measurements = assigned(source, dealt, found);
  report(source, dealt.doubtful, found, ids);
  source.history = found.history;
  source.unassociated.clear();
  return ids;
}

/// RFC 4180: step,line,given,landmark,value,clear.
std::string ids_csv(const EstimatedIds& ids) {
  std::string csv = "step,line,given,landmark,value,clear\r\n";
  for (const AssignedMeasurement& one : ids.measurements)
    csv += fmt::format("{:.0f},{},{},{},{},{}\r\n", one.step,
                       one.line > 0 ? std::to_string(one.line) : "", csv_field(one.given),
                       csv_field(one.found), csv_number(one.value), one.clear ? 1 : 0);
  return csv;
}

MapDraft associate(MapDraft draft, const MapJob& job) {
  if (!job.uncertain_ids.empty()) hold_array(draft);
  auto* source = std::get_if<ObservationSource>(&draft.observed);
  if (source == nullptr || (source->unassociated.empty() && job.uncertain_ids.empty()))
    return draft;
  const EstimatedIds ids = estimate_ids(*source, job.uncertain_ids);
  MapResult& result = draft.result;
  result.remarks.insert(result.remarks.end(), ids.remarks.begin(), ids.remarks.end());
  result.warnings.insert(result.warnings.end(), ids.warnings.begin(), ids.warnings.end());
  result.files.push_back({std::string(kAssociationFile), ids_csv(ids)});
  return draft;
}

}  // namespace

const MapStep kDataAssociation{.take = associate, .file = kAssociationFile};

}  // namespace mapproof
