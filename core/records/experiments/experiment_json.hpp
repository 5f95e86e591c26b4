#pragma once

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/model/experiment.hpp"
#include "core/model/study.hpp"
#include "core/model/topic_study.hpp"
#include "core/records/experiments/external_methods.hpp"
#include "core/records/text_forms.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

/// An experiment from the text of its file (docs/file-formats.md), every bound checked.
///
/// @param source   What to call the file in errors.
/// @param profile  The profile whose merge patch (RFC 7396) is applied first; "" for none.
/// @return Methods in the order of all_methods(), sensors in that of the enumeration.
/// @throws IoError with the location if the text is no such experiment or lacks that profile.
Experiment parse_experiment(std::string_view text, const std::string& source,
                            const std::string& profile = "");

/// The file that parses to exactly this experiment: canonical, every default written out.
std::string experiment_json(const Experiment& experiment);

/// What is wrong with a record beyond its single values, and where: "walk/wall_margin_m".
struct RecordFault {
  std::string pointer;
  std::string what;
};

/// Room for the landmarks, K below their number, sizes of the whole, ids of tables that others
/// could take: the first that is wrong.
std::optional<RecordFault> fault_of(const Experiment& experiment);

/// Sizes of the whole, and every combination of levels of every sweep.
std::optional<RecordFault> fault_of(const TopicExperiment& experiment);

/// SensorOptions::noise is at most this.
inline double greatest_noise(Sensor sensor) {
  return sensor == Sensor::kVisibility ? 0.5 : info(Factor::kNoise).maximum;
}

// The fields of experiments of the mapping methods and of their studies (core/json/fields.hpp).

inline EnumNames enum_names(AffineFit) {
  return names_up_to(AffineFit::kLeastSquares, "affine_fit");
}
inline EnumNames enum_names(AnchorPlacement) {
  return names_up_to(AnchorPlacement::kCluster, "anchor_placement");
}
/// Those that a variation may change, which come first.
inline EnumNames enum_names(Factor) {
  static const std::vector<std::string_view> names = factor_names();
  return {"quantity", names};
}

namespace record_rules {

/// The rule with a description.
constexpr FieldRule described(std::string_view description, FieldRule rule) {
  rule.description = description;
  return rule;
}

inline constexpr double kLongest_m = 1000.0;
inline constexpr FieldRule kLengthOf = {
    .minimum = 0.0, .maximum = kLongest_m, .key = Key::kOptional};
inline constexpr FieldRule kStepLength = {
    .minimum = 1e-4, .maximum = kLongest_m, .key = Key::kOptional};
inline constexpr FieldRule kFlag = {.key = Key::kOptional};
inline constexpr FieldRule kOrdering = {.unique = true, .min_items = 2, .max_items = 1000};
inline constexpr FieldRule kLevels = {.description = "Values of the quantity, ascending.",
                                      .whole_as_integers = true,
                                      .ascending = true,
                                      .min_items = 1,
                                      .max_items = 1000};

/// An optional number that may be what a factor may be.
inline FieldRule of_factor(Factor factor) {
  return {.minimum = info(factor).minimum, .maximum = info(factor).maximum, .key = Key::kOptional};
}

}  // namespace record_rules

/// What every experiment begins with.
template <typename Visitor, typename AnyExperiment>
void name_fields(Visitor& v, AnyExperiment& experiment) {
  v.field("name", experiment.name,
          {.description = "Letters, digits, - and _; names the folder of the study.",
           .max_bytes = 64,
           .form = &kStudyName});
  if constexpr (Visitor::kReads) experiment.title = experiment.name;
  v.field("title", experiment.title,
          {.description = "For readers; by default the name.",
           .max_bytes = 200,
           .key = Key::kOptional});
}

template <typename Visitor, typename AnyExperiment>
void run_fields(Visitor& v, AnyExperiment& experiment) {
  v.field("seed", experiment.seed,
          {.description = "Of all random numbers: the same seed gives the same study.",
           .key = Key::kOptional});
  v.field("layouts", experiment.layouts,
          {.description = "Number of simulated worlds.",
           .minimum = 1,
           .maximum = kMostLayouts,
           .key = Key::kOptional});
  v.field("poses", experiment.poses,
          {.description = "Number of start poses of the robot in each world; each is one run.",
           .minimum = 1,
           .maximum = kMostPoses,
           .key = Key::kOptional});
}

template <typename Visitor>
void fields(Visitor& v, WorldOptions& world) {
  using namespace record_rules;
  v.field("side_m", world.side_m,
          described("Side of the square room, m.", of_factor(Factor::kSide)));
  v.field("landmarks", world.landmarks,
          described("Number of landmarks; they must fit into the room.",
                    of_factor(Factor::kLandmarks)));
  v.field("landmark_diameter_m", world.landmark_diameter_m,
          described("Diameter of a landmark, m.", of_factor(Factor::kDiameter)));
  v.field("gap_m", world.gap_m, described("Least gap between two landmarks, m.", kLengthOf));
  v.field("wall_margin_m", world.wall_margin_m,
          described("Least gap between a landmark and a wall, m.", kLengthOf));
}

template <typename Visitor>
void fields(Visitor& v, WalkOptions& walk) {
  using namespace record_rules;
  v.field("step_m", walk.step_m,
          described("Length of a step between two observations, m.", kStepLength));
  v.field("heading_change_rad", walk.heading_change_rad,
          {.description = "Heading change before a step: uniform within plus or minus this, rad.",
           .minimum = 0.0,
           .maximum = std::numbers::pi,
           .key = Key::kOptional});
  v.field("substep_m", walk.substep_m,
          described("Length of the substeps at which collisions are checked, m.", kStepLength));
  v.field("clearance_m", walk.clearance_m,
          described("Least distance of the robot's centre to the surface of a landmark, m.",
                    kLengthOf));
  v.field("wall_margin_m", walk.wall_margin_m,
          described("Least distance of the robot's centre to a wall, m.", kLengthOf));
}

template <typename Visitor>
void fields(Visitor& v, SolverOptions& solver) {
  using namespace record_rules;
  v.field("smacof_relative_fall", solver.smacof_relative_fall,
          described("SMACOF stops when a step reduces the stress by less than this share.",
                    of_factor(Factor::kSmacofFall)));
  v.field("smacof_knn_relative_fall", solver.smacof_knn_relative_fall,
          described("The same for SMACOF with kNN weights.", of_factor(Factor::kSmacofKnnFall)));
  v.field(
      "only_seen_together", solver.only_seen_together,
      described("Visibility: pairs of landmarks that were never seen together are not neighbours.",
                kFlag));
}

/// The methods to try, by name, each with the values of its parameter.
template <typename Visitor>
void grid_fields(Visitor& v, std::vector<MethodGrid>& grids) {
  v.type("methods");
  v.about("The methods to try, each with the values of its parameter.");
  v.key_count(1, all_methods().size());
  for (const MethodInfo& method : all_methods()) {
    const auto known = std::ranges::find(grids, method.method, &MethodGrid::method);
    const bool is_there = known != grids.end();
    MethodGrid grid = is_there ? *known : MethodGrid{method.method, {}};
    const auto visit = [&](auto& values) {
      if (const auto& parameter = method.parameter)
        values.field(parameter->symbol, grid.parameters,
                     {.description = parameter->meaning,
                      .minimum = parameter->minimum,
                      .maximum = parameter->maximum,
                      .whole_as_integers = true,
                      .integer = parameter->integer,
                      .ascending = true,
                      .min_items = 1,
                      .max_items = 1000});
      if constexpr (std::remove_reference_t<decltype(values)>::kReads) grids.push_back(grid);
    };
    v.group(method.name, visit,
            {.description = method.label, .key = Key::kOptional, .written = is_there});
  }
}

template <typename Visitor>
void fields(Visitor& v, PublishedValue& value) {
  setting_fields(v, value.setting);
  v.field(
      "mpe_m", value.mpe_m,
      {.description = "Printed mean position error, m.", .minimum = 1e-9, .maximum = kFarthest_m});
  v.field("moe_percent", value.moe_percent,
          {.description = "Printed mean orientation error, %.", .minimum = 0.0, .maximum = 100.0});
  v.field("note", value.note,
          {.description = "Why ours cannot match it.", .max_bytes = 1000, .key = Key::kIfAny});
}

template <typename Visitor>
void fields(Visitor& v, Published& published) {
  v.type("published");
  v.about("Numbers that a paper printed, compared with ours.");
  v.field("source", published.source,
          {.description = "Where the numbers were printed: \"Yairi 2007, Table 1\".",
           .not_empty = true,
           .max_bytes = 200});
  v.field("table", published.table,
          {.description = "Id of the table that compares ours with them; others go with it.",
           .max_bytes = 40,
           .form = &kTableId,
           .key = Key::kIfAny});
  v.field("values", published.values, {.description = "The printed numbers.", .max_items = 1000});
  v.field("notes", published.notes,
          {.description = "On all of the values.",
           .max_items = 100,
           .max_bytes = 1000,
           .key = Key::kIfAny});
  v.field("orderings", published.orderings,
          {.description = "Methods from least to greatest MPE, as the source has them.",
           .max_items = 1000,
           .items = &record_rules::kOrdering,
           .key = Key::kIfAny});
}

/// @param steps  The only checkpoint, which is then not named; empty: its own.
template <typename Visitor>
void sensor_fields(Visitor& v, SensorStudy& study, std::optional<int> steps) {
  using namespace record_rules;
  SensorOptions& sensor = study.sensor;
  const bool is_visibility = sensor.sensor == Sensor::kVisibility;
  v.type(is_visibility ? "visibility" : "metric_sensor");
  if (is_visibility) {
    v.field("visual_angle_rad", sensor.visual_angle_rad,
            {.description = "A landmark is seen if it appears wider than this angle, rad.",
             .minimum = 1e-6,
             .maximum = std::numbers::pi,
             .key = Key::kOptional});
    v.field("occlusion", sensor.occlusion, described("Whether landmarks hide others.", kFlag));
  }
  v.field("noise", sensor.noise,
          {.description = is_visibility ? "Share of entries that are flipped."
                                        : "Standard deviation, rad or m.",
           .minimum = 0.0,
           .maximum = greatest_noise(sensor.sensor),
           .key = Key::kOptional});
  v.field(
      "dropout_share", sensor.dropout_share,
      described("Share of the entries that are lost at random.", of_factor(Factor::kDropoutShare)));
  if (!is_visibility) {
    FieldRule reach = described("Landmarks further away are not measured, m; left out: no limit.",
                                of_factor(Factor::kReach));
    reach.written = sensor.reach_m > 0.0;
    v.field("reach_m", sensor.reach_m, reach);
  }
  if (steps)
    study.checkpoints = {*steps};
  else
    v.field("checkpoints", study.checkpoints,
            {.description = "Steps at which maps are built, ascending.",
             .minimum = info(Factor::kSteps).minimum,
             .maximum = kMostSteps,
             .ascending = true,
             .min_items = 1,
             .max_items = 1000});
  v.group("methods", [&](auto& methods) { grid_fields(methods, study.methods); },
          {.description = "The methods to try, each with the values of its parameter."});
  if (!steps)
    v.field("published", study.published,
            {.description = "Numbers that a paper printed, compared with ours.",
             .key = Key::kOptional,
             .written = !study.published.source.empty()});
}

constexpr std::string_view sensor_meaning(Sensor sensor) {
  return sensor == Sensor::kVisibility ? "Whether each landmark is seen, 0 or 1."
         : sensor == Sensor::kBearing
             ? "The direction of each landmark from the robot's heading, rad."
             : "The distance of each landmark, m.";
}

/// The sensors by name. @param steps  As above.
template <typename Visitor>
void sensors_fields(Visitor& v, std::vector<SensorStudy>& studies, std::optional<int> steps) {
  v.key_count(1, 3);
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange}) {
    const auto known = std::ranges::find(
        studies, sensor, [](const SensorStudy& study) { return study.sensor.sensor; });
    const bool is_there = known != studies.end();
    SensorStudy study;
    if (is_there) study = *known;
    study.sensor.sensor = sensor;
    const auto visit = [&](auto& options) {
      sensor_fields(options, study, steps);
      if constexpr (std::remove_reference_t<decltype(options)>::kReads) studies.push_back(study);
    };
    v.group(name(sensor), visit,
            {.description = sensor_meaning(sensor), .key = Key::kOptional, .written = is_there});
  }
}

template <typename Visitor>
void fields(Visitor& v, Variation& variation) {
  using namespace record_rules;
  v.field("id", variation.id,
          described("Name of the variation, part of the ids of its figures.", kId));
  v.field("sensor", variation.sensor, {.description = "The sensor whose maps are repeated."});
  v.field("quantity", variation.factor, {.description = "What is varied."});
  FieldRule levels = kLevels;
  levels.minimum = info(variation.factor).minimum;
  levels.maximum = info(variation.factor).maximum;
  levels.integer = info(variation.factor).integer;
  v.field("levels", variation.levels, levels);
  v.field("step", variation.step,
          {.description = "Observations of the maps; left out: the last checkpoint.",
           .minimum = info(Factor::kSteps).minimum,
           .maximum = kMostSteps,
           .key = Key::kOptional});
  v.field("placement", variation.placement,
          {.description = "Where the anchors are, instead of the experiment's placement.",
           .key = Key::kIfAny});
  std::vector<MethodGrid> grids = grids_of(variation.settings);
  v.group("methods", [&](auto& methods) { grid_fields(methods, grids); },
          {.description = "The methods to try, each with the values of its parameter."});
  if constexpr (Visitor::kReads) variation.settings = settings_of(grids);
}

/// A figure as files have it: each kind with keys of its own.
template <FigureKind kKind>
struct FigureOf : PaperFigure {};

template <typename Visitor, FigureKind kKind>
void fields(Visitor& v, FigureOf<kKind>& figure) {
  figure.kind = kKind;
  v.field("id", figure.id,
          {.description = "Id of the figure: fig-3.", .max_bytes = 64, .form = &kFigureId});
  v.tag("kind", name(kKind));
  v.field("sensor", figure.sensor, {.description = "The sensor that it shows."});
  if (kKind == FigureKind::kMeasurement && figure.sensor == Sensor::kRange)
    v.refuse("sensor", "a scan of ranges has no figure; expected visibility or bearing");
  if constexpr (kKind == FigureKind::kErrorCurve)
    v.field("methods", figure.methods,
            {.description = "The methods whose errors are drawn.",
             .unique = true,
             .min_items = 1,
             .max_items = 100});
  if constexpr (kKind == FigureKind::kMap) {
    PublishedValue example = figure.example.value_or(PublishedValue{});
    setting_fields(v, example.setting);
    v.field("mpe_m", example.mpe_m,
            {.description = "Printed mean position error, m: of all runs the nearest is drawn.",
             .minimum = 0.0,
             .maximum = kFarthest_m});
    v.field("moe_percent", example.moe_percent,
            {.description = "Printed mean orientation error, %: of all runs the nearest is drawn.",
             .minimum = 0.0,
             .maximum = 100.0});
    if constexpr (Visitor::kReads) {
      figure.example = example;
      figure.methods = {example.setting.method};
    }
  }
}

using AnyFigure = std::variant<FigureOf<FigureKind::kIdea>, FigureOf<FigureKind::kMeasurement>,
                               FigureOf<FigureKind::kErrorCurve>, FigureOf<FigureKind::kMap>>;

inline AnyFigure any_figure(const PaperFigure& figure) {
  switch (figure.kind) {
    case FigureKind::kIdea:
      return FigureOf<FigureKind::kIdea>{figure};
    case FigureKind::kMeasurement:
      return FigureOf<FigureKind::kMeasurement>{figure};
    case FigureKind::kErrorCurve:
      return FigureOf<FigureKind::kErrorCurve>{figure};
    default:
      return FigureOf<FigureKind::kMap>{figure};
  }
}

template <typename Visitor>
void figure_fields(Visitor& v, std::vector<PaperFigure>& figures) {
  std::vector<AnyFigure> all;
  for (const PaperFigure& figure : figures) all.push_back(any_figure(figure));
  v.field("figures", all,
          {.description = "Figures of a paper that are drawn again, under ids of their own.",
           .max_items = 100,
           .key = Key::kIfAny});
  if constexpr (Visitor::kReads)
    for (const AnyFigure& figure : all)
      figures.push_back(std::visit([](const PaperFigure& one) { return one; }, figure));
}

template <typename Visitor>
void fields(Visitor& v, Experiment& experiment) {
  using namespace record_rules;
  v.file("mapproof.experiment",
         "A simulated study: worlds, walks, sensors and the methods that map them.");
  name_fields(v, experiment);
  run_fields(v, experiment);
  v.field("world", experiment.world,
          {.description = "The room and its landmarks.", .key = Key::kOptional});
  v.field("walk", experiment.walk, {.description = "How the robot moves.", .key = Key::kOptional});
  v.field(
      "anchors", experiment.anchors,
      described("Number of anchors: landmarks with known positions, which the map is aligned to.",
                of_factor(Factor::kAnchors)));
  v.field("anchor_placement", experiment.anchor_placement,
          {.description = "Anchors along the walls, drawn at random for each layout, or in a "
                          "cluster near one corner.",
           .key = Key::kOptional});
  v.field(
      "affine_fit", experiment.affine_fit,
      {.description = "How a map is aligned to the anchors: by least distances or least squares.",
       .key = Key::kOptional});
  v.field("solver", experiment.solver,
          {.description = "When iterative methods stop, and what neighbours are.",
           .key = Key::kOptional});
  v.group("sensors",
          [&](auto& sensors) { sensors_fields(sensors, experiment.sensors, std::nullopt); },
          {.description =
               "What the robot observes, and how it is mapped: visibility, bearing, range."});
  v.field("variations", experiment.variations,
          {.description = "Side studies: some methods over the levels of one quantity.",
           .max_items = 100,
           .key = Key::kIfAny});
  figure_fields(v, experiment.figures);
  std::vector<ExternalMethod> external = experiment.external_methods;
  v.field("external_methods", external,
          {.description = "Mapping methods that are commands, run on what every sensor observes.",
           .max_items = 100,
           .key = Key::kIfAny});
  if constexpr (Visitor::kReads) add_external_methods(experiment, external);
  check_ids(v, "variations", experiment.variations);
  check_ids(v, "figures", experiment.figures);
  if constexpr (Visitor::kReads) {
    for (Variation& variation : experiment.variations)
      if (const auto* study = find_sensor(experiment, variation.sensor); variation.step == 0)
        variation.step = study == nullptr ? 0 : study->checkpoints.back();
    if (const auto fault = fault_of(experiment)) v.refuse(fault->pointer, fault->what);
  }
}

/// The head of a study: study.json.
template <typename Visitor>
void fields(Visitor& v, Study& study) {
  v.file("mapproof.study", "study.json: what was asked for, and what made it.");
  v.field("experiment", study.experiment);
  v.field("provenance", study.provenance);
}

}  // namespace mapproof
