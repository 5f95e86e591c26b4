#include "core/records/studies/results_of.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

std::string layout_of(const RunId& run) { return fmt::format("layout-{}", run.layout); }

Level steps_level(double steps) { return {.factor = std::string(kStepsFactor), .value = steps}; }

void add_family(Results& results, const MethodSetting& setting) {
  if (setting.parameter)
    results.families[slug(setting)] = {.name = std::string(info(setting.method).name),
                                       .parameter = parameter_text(setting)};
}

/// Adds what came of one method under one condition in one run.
class RecordRows {
 public:
  RecordRows(Results& results, const Condition& at, const Name& method, const Name& run,
             const Name& group)
      : results_(results) {
    row_.at = at;
    row_.method = method;
    row_.run = run;
    row_.group = group;
  }

  void add(std::string_view quantity, double value) {
    row_.quantity = quantity;
    row_.value = value;
    results_.rows.push_back(row_);
  }

  void add(const std::optional<Score>& score) {
    add("mpe_m", score ? score->mpe_m : kNaN);
    add("moe_percent", score ? score->moe_percent : kNaN);
    add("mpe_all_fitted_m", score ? score->mpe_all_fitted_m : kNaN);
    add("moe_unmirrored_percent", score ? score->moe_unmirrored_percent : kNaN);
  }

  void add(const std::vector<Status>& statuses) {
    RunOutcome outcome{.at = row_.at, .method = row_.method, .run = row_.run};
    for (const Status& status : statuses) outcome.codes.emplace_back(name(status.code));
    results_.outcomes.push_back(std::move(outcome));
  }

 private:
  Results& results_;
  Result row_;
};

void add_run(Results& results, const Experiment& experiment, const Run& run) {
  for (const RunRecord& record : run.records) {
    RecordRows rows(results,
                    condition(std::string(name(record.sensor)), {steps_level(record.step)}),
                    slug(record.setting), slug(run.id), layout_of(run.id));
    add_family(results, record.setting);
    rows.add(record.score);
    rows.add("iterations", record.iterations);
    if (record.stress) rows.add("stress", *record.stress);
    if (record.certificate) rows.add("relative_gap", record.certificate->relative_gap);
    rows.add(record.statuses);
  }
  for (const VariationRecord& record : run.variations) {
    const auto found = std::ranges::find(experiment.variations, record.variation, &Variation::id);
    if (found == experiment.variations.end()) continue;
    RecordRows rows(results,
                    condition(std::string(name(found->sensor)),
                              {steps_level(found->step), {record.variation, record.level}}),
                    slug(record.setting), slug(run.id), layout_of(run.id));
    add_family(results, record.setting);
    rows.add(record.score);
    rows.add(record.statuses);
  }
}

void add_record(Results& results, const SlamRun& run, const SlamRecord& record) {
  RecordRows rows(results, condition(run.id), std::string(info(record.method).name), run.id,
                  run.id);
  // The other alignments' errors follow from the same path.
  if (!record.errors.empty()) {
    const TrajectoryError& error = record.errors.front();
    rows.add("path_mean_m", error.mean_m);
    rows.add("path_rmse_m", error.rmse_m);
    rows.add("last_tenth_m", error.last_tenth_m);
    rows.add("best_tenth_m", error.best_tenth_m);
    rows.add("worst_tenth_m", error.worst_tenth_m);
    if (error.landmarks_m) rows.add("landmarks_m", *error.landmarks_m);
  } else if (run.log.ground_truth) {
    rows.add("path_mean_m", kNaN);
    rows.add("path_rmse_m", kNaN);
  }
  rows.add("range_scale", record.estimate.range_scale);
  rows.add("iterations", record.estimate.iterations);
  if (record.estimate.cost) rows.add("cost", *record.estimate.cost);
  rows.add(record.estimate.statuses);
}

void add_fit(Results& results, const SlamRun& run) {
  if (!run.fit) return;
  RecordRows rows(results, condition(run.id), std::string(info(SlamMethod::kRefined).name), run.id,
                  run.id);
  for (const FitNumber& number : fit_numbers(*run.fit)) rows.add(number.quantity, number.value);
}

void add_convergence(Results& results, const ConvergenceCurve& curve) {
  for (const ConvergencePoint& point : curve.points) {
    RecordRows rows(results, condition("convergence/" + curve.id, {steps_level(point.steps)}),
                    std::string(info(SlamMethod::kSpectralKnown).name), "", "");
    rows.add("observation_error", point.observation.mean);
    rows.add("landmarks_m", point.landmarks_m.mean);
    rows.add("positions_m", point.positions_m.mean);
    rows.add("sine", point.sine.mean);
  }
}

void add_histories(Results& results, const RangeHistoryStudy& histories) {
  for (const RangeHistoryMap& map : histories.maps) {
    RecordRows rows(results, condition(map.squared ? "histories/squared" : "histories/range"),
                    map.setting ? slug(*map.setting) : "spectral", "", "");
    if (map.setting) add_family(results, *map.setting);
    rows.add(map.score);
    rows.add(map.statuses);
  }
}

/// The name of an experiment as the beginning of ids: [a-z][a-z0-9-]*.
std::string figure_prefix(const std::string& name) {
  std::string id = lower_case(name);
  std::ranges::replace(id, '_', '-');
  return id.front() >= 'a' && id.front() <= 'z' ? id : "study-" + id;
}

std::string group_of(const TopicPart& part) { return part.run ? layout_of(*part.run) : part.id; }

}  // namespace

Results results_of(const Study& study) {
  Results results{.are_repeats = true};
  for (const Run& run : study.runs) add_run(results, study.experiment, run);
  sort_results(results);
  return results;
}

Results results_of(const SlamStudy& study) {
  Results results;
  for (const SlamRun& run : study.runs) {
    for (const SlamRecord& record : run.records) add_record(results, run, record);
    add_fit(results, run);
  }
  for (const ConvergenceCurve& curve : study.convergence) add_convergence(results, curve);
  if (study.histories) add_histories(results, *study.histories);
  sort_results(results);
  return results;
}

Results results_of(const SlamRun& run) {
  Results results;
  for (const SlamRecord& record : run.records) add_record(results, run, record);
  add_fit(results, run);
  sort_results(results);
  return results;
}

Results results_of(const MapRecord& map) {
  Results results;
  const MethodSetting* setting = setting_of(map);
  RecordRows rows(results, condition(std::string(sensor_name(map)), {steps_level(map.step)}),
                  setting != nullptr ? slug(*setting) : std::string(method_name(map)), "", "");
  if (setting != nullptr) add_family(results, *setting);
  rows.add(map.score);
  rows.add(map.statuses);
  sort_results(results);
  return results;
}

Results results_of(const TopicStudy& study) {
  Results results{.are_repeats = study.experiment.data.empty()};
  for (const Quantity& quantity : study.design.quantities) results.quantities.declare(quantity);
  for (const TopicPart& part : study.parts)
    for (const TopicOutcome& outcome : part.outcomes) {
      RecordRows rows(results, outcome.at, outcome.method, part.id, group_of(part));
      for (const auto& [quantity, value] : outcome.values) rows.add(quantity, value);
      rows.add(outcome.statuses);
    }
  sort_results(results);
  return results;
}

ResultsStudy labelled_results(const TopicStudy& study) {
  const TopicExperiment& experiment = study.experiment;
  ResultsStudy labelled{.name = figure_prefix(experiment.name),
                        .title = experiment.title,
                        .question = {},
                        .command = {},
                        .quantities = {},
                        .quantity_labels = {},
                        .setups = {},
                        .methods = {},
                        .factors = {},
                        .runs = {},
                        .results = results_of(study)};
  for (const Quantity& quantity : study.design.quantities) {
    labelled.quantities.push_back(quantity.id);
    labelled.quantity_labels.push_back({.id = quantity.id, .label = quantity.label});
  }
  for (const TopicSetup& setup : study.design.setups) {
    labelled.setups.push_back({.id = setup.id, .label = setup.title});
    for (const SetupFactor& factor : setup.factors)
      if (std::ranges::find(labelled.factors, factor.id, &Label::id) == labelled.factors.end())
        labelled.factors.push_back({.id = factor.id, .label = factor.label, .unit = factor.unit});
  }
  for (const StudiedMethod& method : study.design.methods)
    labelled.methods.push_back({.id = method.id, .label = method.label});
  for (const DataSet& set : experiment.data)
    labelled.runs.push_back({.id = set.id, .label = set.title});
  complete(labelled);
  return labelled;
}

std::vector<Result> seconds_of(std::span<const Timing> timings) {
  std::vector<Result> rows;
  for (const Timing& timing : timings)
    rows.push_back({.at = condition(std::string(name(timing.sensor)), {steps_level(timing.step)}),
                    .method = slug(timing.setting),
                    .quantity = "seconds",
                    .run = slug(timing.run),
                    .group = layout_of(timing.run),
                    .value = timing.seconds});
  return rows;
}

std::vector<Result> seconds_of(const SlamTimings& timings) {
  std::vector<Result> rows;
  for (const SlamTiming& timing : timings.methods)
    rows.push_back({.at = condition(timing.run),
                    .method = std::string(info(timing.method).name),
                    .quantity = "seconds",
                    .run = timing.run,
                    .group = timing.run,
                    .value = timing.seconds});
  for (const FactorizationCost& cost : timings.factorization)
    rows.push_back(
        {.at = condition("factorization", {{"landmarks", static_cast<double>(cost.landmarks)},
                                           steps_level(static_cast<double>(cost.steps))}),
         .method = std::string(info(SlamMethod::kSpectral).name),
         .quantity = "seconds",
         .value = cost.seconds});
  return rows;
}

std::vector<Result> seconds_of(const TopicStudy& study) {
  std::vector<Result> rows;
  for (const TopicPart& part : study.parts)
    for (const MethodSeconds& timing : part.seconds)
      rows.push_back({.at = condition("all"),
                      .method = timing.method,
                      .quantity = "seconds",
                      .run = part.id,
                      .group = group_of(part),
                      .value = timing.seconds});
  return rows;
}

}  // namespace mapproof
