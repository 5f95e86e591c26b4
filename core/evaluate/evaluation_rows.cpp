#include "core/evaluate/evaluation_rows.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

struct UnitNames {
  PairUnit unit;
  const char* setup;
  const char* setup_label;
  const char* factor;
  const char* factor_label;
  const char* factor_unit;
};
constexpr std::array kUnits = {
    UnitNames{PairUnit::kMetres, "distance", "Relative errors over distance", "distance_m",
              "distance", "m"},
    UnitNames{PairUnit::kSeconds, "time", "Relative errors over time", "seconds", "time", "s"},
    UnitNames{PairUnit::kPoses, "frames", "Relative errors over poses", "poses", "poses", ""}};
constexpr const char* kPoses = "poses";
constexpr const char* kLandmarks = "landmarks";

const UnitNames& names_of(PairUnit unit) {
  return *std::ranges::find(kUnits, unit, &UnitNames::unit);
}

/// All quantities, the most informative first.
std::vector<Quantity> evaluation_quantities() {
  const auto lower = [](const char* id, const char* label, const char* unit) {
    return study_quantity(id, label, unit, Better::kLower);
  };
  return {lower("ate_rmse_m", "ATE, RMSE", "m"),
          lower("ate_mean_m", "ATE, mean", "m"),
          lower("ate_median_m", "ATE, median", "m"),
          lower("ate_max_m", "ATE, greatest", "m"),
          lower("ate_rotation_rmse_deg", "absolute orientation error, RMSE", "°"),
          study_quantity(kAssociatedPercent, "associated poses", "%", Better::kHigher),
          study_quantity("aligned_scale", "scale of the alignment", "", Better::kNeither),
          lower("rpe_rmse_m", "RPE, RMSE", "m"),
          lower("rpe_mean_m", "RPE, mean", "m"),
          lower("rpe_median_m", "RPE, median", "m"),
          lower("rpe_max_m", "RPE, greatest", "m"),
          lower("rpe_rotation_rmse_deg", "relative orientation error, RMSE", "°"),
          lower("drift_percent", "drift", "%"),
          lower("landmark_mean_m", "landmark error, mean", "m"),
          lower("landmark_rmse_m", "landmark error, RMSE", "m"),
          lower("landmark_max_m", "landmark error, greatest", "m"),
          study_quantity("landmarks_found_percent", "landmarks found", "%", Better::kHigher),
          lower("landmarks_spurious", "landmarks that do not exist", "")};
}

double rmse(const Eigen::VectorXd& errors) {
  return errors.size() == 0 ? kNaN : error_statistics(errors).rmse;
}

/// Collects the rows of one run.
class Rows {
 public:
  Rows(const EvaluatedRun& run, std::vector<Result>& rows) : run_(run), rows_(rows) {}

  void add(const Condition& at, const char* quantity, double value) {
    rows_.push_back({.at = at,
                     .method = run_.method,
                     .quantity = quantity,
                     .run = run_.run,
                     .group = run_.group,
                     .value = value});
  }

  void add(const Condition& at, const std::array<const char*, 4>& quantities,
           const std::optional<ErrorStatistics>& found) {
    const ErrorStatistics errors = found.value_or(ErrorStatistics{kNaN, kNaN, kNaN, kNaN});
    const std::array values = {errors.rmse, errors.mean, errors.median, errors.maximum};
    for (std::size_t i = 0; i < values.size(); ++i) add(at, quantities[i], values[i]);
  }

 private:
  const EvaluatedRun& run_;
  std::vector<Result>& rows_;
};

void add_absolute(const std::optional<PathEvaluation>& path, Rows& rows) {
  const Condition at = condition(kPoses);
  std::optional<ErrorStatistics> errors;
  if (path) errors = error_statistics(path->poses.error_m);
  rows.add(at, {"ate_rmse_m", "ate_mean_m", "ate_median_m", "ate_max_m"}, errors);
  if (path && path->poses.error_deg.size() > 0)
    rows.add(at, "ate_rotation_rmse_deg", rmse(path->poses.error_deg));
  rows.add(at, kAssociatedPercent, path ? path->associated_percent : kNaN);
  if (path && path->alignment.scale != 1.0) rows.add(at, "aligned_scale", path->alignment.scale);
}

/// The mean of those that are known; NaN without.
double known_mean(const Eigen::VectorXd& values) {
  double sum = 0.0;
  int count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return count == 0 ? kNaN : sum / count;
}

void add_relative(const RelativeErrors& errors, Rows& rows) {
  const UnitNames& names = names_of(errors.spacing.unit);
  const Condition at = condition(names.setup, {{names.factor, errors.spacing.length}});
  rows.add(at, {"rpe_rmse_m", "rpe_mean_m", "rpe_median_m", "rpe_max_m"},
           error_statistics(errors.error_m));
  rows.add(at, "rpe_rotation_rmse_deg", rmse(errors.error_deg));
  rows.add(at, "drift_percent", known_mean(errors.percent));
}

void add_landmarks(const std::optional<LandmarkEvaluation>& landmarks, Rows& rows) {
  const Condition at = condition(kLandmarks);
  std::optional<ErrorStatistics> errors;
  if (landmarks) errors = error_statistics(landmarks->error_m);
  rows.add(at, "landmark_mean_m", errors ? errors->mean : kNaN);
  rows.add(at, "landmark_rmse_m", errors ? errors->rmse : kNaN);
  rows.add(at, "landmark_max_m", errors ? errors->maximum : kNaN);
  const double found = landmarks ? static_cast<double>(landmarks->error_m.size()) : 0.0;
  rows.add(at, "landmarks_found_percent",
           landmarks ? 100.0 * found / (found + static_cast<double>(landmarks->missed)) : kNaN);
  rows.add(at, "landmarks_spurious", landmarks ? static_cast<double>(landmarks->spurious) : kNaN);
}

/// Labels of the setups and factors that rows have.
void add_association(ResultsStudy& study) {
  std::set<std::string> setups;
  for (const Result& row : study.results.rows) setups.insert(row.at.setup);
  if (setups.contains(kPoses)) study.setups.push_back({kPoses, "Absolute errors"});
  for (const UnitNames& names : kUnits)
    if (setups.contains(names.setup)) {
      study.setups.push_back({names.setup, names.setup_label});
      study.factors.push_back({names.factor, names.factor_label, names.factor_unit});
    }
  if (setups.contains(kLandmarks)) study.setups.push_back({kLandmarks, "Landmarks"});
}

}  // namespace

ResultsStudy evaluation_study(const std::vector<EvaluatedRun>& runs,
                              const std::vector<PairSpacing>& spacings) {
  ResultsStudy study;
  study.results.are_repeats = true;
  for (const EvaluatedRun& run : runs) {
    if (std::ranges::find(study.methods, run.method, &Label::id) == study.methods.end())
      study.methods.push_back({run.method, run.method});
    Rows rows(run, study.results.rows);
    if (run.has_path) add_absolute(run.path, rows);
    if (run.has_path && run.path)
      for (const RelativeErrors& errors : run.path->relative) add_relative(errors, rows);
    if (run.has_path && !run.path)
      for (const PairSpacing& spacing : spacings) {
        const UnitNames& names = names_of(spacing.unit);
        rows.add(condition(names.setup, {{names.factor, spacing.length}}),
                 {"rpe_rmse_m", "rpe_mean_m", "rpe_median_m", "rpe_max_m"}, std::nullopt);
      }
    if (run.has_landmarks) add_landmarks(run.landmarks, rows);
  }
  std::set<std::string> used;
  for (const Result& row : study.results.rows) used.insert(row.quantity);
  for (const Quantity& quantity : evaluation_quantities())
    if (used.contains(quantity.id)) {
      study.results.quantities.declare(quantity);
      study.quantities.push_back(quantity.id);
    }
  add_association(study);
  sort_results(study.results);
  return study;
}

}  // namespace mapproof
