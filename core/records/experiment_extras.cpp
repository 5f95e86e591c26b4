#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/json/text_input.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

/// The sensor that a value names, which the experiment must have.
const SensorStudy& read_sensor_of(const Experiment& experiment, const JsonCursor& value) {
  const Sensor sensor = read_sensor(value);
  const SensorStudy* study = find_sensor(experiment, sensor);
  if (study == nullptr) value.fail(fmt::format("the experiment has no sensor {}", name(sensor)));
  return *study;
}

Factor read_factor(const JsonCursor& value) {
  const std::string text = value.text();
  if (const std::optional<Factor> factor = factor_named(text)) return *factor;
  value.fail(
      fmt::format("expected one of {}, got {}", fmt::join(factor_names(), ", "), in_quotes(text)));
}

double read_level(const Variation& variation, const Experiment& experiment,
                  const JsonCursor& value) {
  const FactorInfo& factor = info(variation.factor);
  double most = factor.maximum;
  if (variation.factor == Factor::kNoise && variation.sensor == Sensor::kVisibility) most = 0.5;
  if (variation.factor == Factor::kAnchors) most = experiment.world.landmarks - 1;
  if (!factor.integer) return value.number(factor.minimum, most);
  return value.integer32(static_cast<int>(factor.minimum), static_cast<int>(most));
}

Variation read_variation(const Experiment& experiment, const JsonCursor& object) {
  object.allow_only({"id", "sensor", "quantity", "levels", "step", "placement", "methods"});
  Variation variation;
  variation.id = read_id(object.at("id"));
  const SensorStudy study = read_sensor_of(experiment, object.at("sensor"));
  variation.sensor = study.sensor.sensor;
  variation.factor = read_factor(object.at("quantity"));
  variation.levels = read_ascending<double>(object.at("levels"), [&](const JsonCursor& item) {
    return read_level(variation, experiment, item);
  });
  variation.step = study.checkpoints.back();
  if (const auto step = object.find("step")) variation.step = step->integer32(3, kMostSteps);
  if (const auto placement = object.find("placement"))
    variation.placement = read_anchor_placement(*placement);
  const JsonCursor methods = object.at("methods");
  const std::vector<MethodGrid> grids = read_methods(methods);
  check_grids(grids, experiment.world.landmarks, methods);
  variation.settings = settings_of(grids);
  return variation;
}

FigureKind read_kind(const JsonCursor& value) {
  const std::string text = value.text();
  if (const std::optional<FigureKind> kind = figure_kind_named(text)) return *kind;
  value.fail("expected idea, measurement, error_curve or map, got " + in_quotes(text));
}

/// "fig-4": kept apart from the ids that the program gives.
std::string read_figure_id(const JsonCursor& value) {
  const std::string id = read_id(value);
  if (!id.starts_with("fig-")) value.fail("expected \"fig-\" first, got " + in_quotes(id));
  return id;
}

PaperFigure read_figure(const Experiment& experiment, const JsonCursor& object) {
  PaperFigure figure{.id = read_figure_id(object.at("id")), .methods = {}, .example = {}};
  figure.kind = read_kind(object.at("kind"));
  figure.sensor = read_sensor_of(experiment, object.at("sensor")).sensor.sensor;
  if (figure.kind == FigureKind::kMeasurement && figure.sensor == Sensor::kRange)
    object.at("sensor").fail("a look of ranges has no figure; expected visibility or bearing");
  std::vector<std::string_view> keys = {"id", "kind", "sensor"};
  if (figure.kind == FigureKind::kErrorCurve) {
    keys.push_back("methods");
    for (const JsonCursor& item : object.at("methods").elements(1, 100)) {
      const Method method = read_method(item.text(), item);
      if (std::ranges::find(figure.methods, method) != figure.methods.end())
        item.fail(in_quotes(info(method).name) + " is there twice");
      figure.methods.push_back(method);
    }
  } else if (figure.kind == FigureKind::kMap) {
    keys.insert(keys.end(), {"mpe_m", "moe_percent"});
    PublishedValue& example = figure.example.emplace();
    example.setting = read_setting(object, keys);
    example.mpe_m = object.at("mpe_m").number(0.0, kFarthest_m);
    example.moe_percent = object.at("moe_percent").number(0.0, 100.0);
    figure.methods = {example.setting.method};
  }
  object.allow_only(keys);
  return figure;
}

/// @throws IoError at an id that was there before.
template <typename Value>
void check_ids(const std::vector<Value>& values, const JsonCursor& array) {
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (values[i].id == values[j].id) array.element(i).at("id").fail("is there twice");
}

Json variation_value(const Variation& variation) {
  Json levels = Json::array();
  for (const double level : variation.levels) levels.push_back(number_value(level));
  Json value = {{"id", variation.id},
                {"sensor", name(variation.sensor)},
                {"quantity", info(variation.factor).name},
                {"levels", std::move(levels)},
                {"step", variation.step}};
  if (variation.placement) value["placement"] = name(*variation.placement);
  value["methods"] = methods_value(grids_of(variation.settings));
  return value;
}

Json figure_value(const PaperFigure& figure) {
  Json value = {{"id", figure.id}, {"kind", name(figure.kind)}, {"sensor", name(figure.sensor)}};
  if (figure.kind == FigureKind::kErrorCurve)
    for (const Method method : figure.methods) value["methods"].push_back(info(method).name);
  if (figure.example) {
    put_setting(value, figure.example->setting);
    value["mpe_m"] = figure.example->mpe_m;
    value["moe_percent"] = figure.example->moe_percent;
  }
  return value;
}

}  // namespace

AnchorPlacement read_anchor_placement(const JsonCursor& value) {
  const std::string text = value.text();
  if (const std::optional<AnchorPlacement> placement = anchor_placement_named(text))
    return *placement;
  value.fail("expected walls, random or cluster, got " + in_quotes(text));
}

void read_extras(const JsonCursor& document, Experiment& experiment) {
  if (const auto variations = document.find("variations")) {
    for (const JsonCursor& item : variations->elements(0, 100))
      experiment.variations.push_back(read_variation(experiment, item));
    check_ids(experiment.variations, *variations);
  }
  if (const auto figures = document.find("figures")) {
    for (const JsonCursor& item : figures->elements(0, 100))
      experiment.figures.push_back(read_figure(experiment, item));
    check_ids(experiment.figures, *figures);
  }
}

void put_extras(Json& value, const Experiment& experiment) {
  if (!experiment.variations.empty()) {
    Json& all = value["variations"] = Json::array();
    for (const Variation& variation : experiment.variations)
      all.push_back(variation_value(variation));
  }
  if (!experiment.figures.empty()) {
    Json& all = value["figures"] = Json::array();
    for (const PaperFigure& figure : experiment.figures) all.push_back(figure_value(figure));
  }
}

}  // namespace mapproof
