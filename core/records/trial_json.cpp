#include "core/records/trial_json.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"
#include "core/records/certainty_values.hpp"
#include "core/records/json_values.hpp"
#include "core/records/map_values.hpp"
#include "core/records/provenance_values.hpp"
#include "core/records/quantity_values.hpp"
#include "core/records/trial_experiment_json.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr std::size_t kMost = 10'000;  ///< Setups, series, quantities, levels, maps.
constexpr std::size_t kMostFactors = 10;

Json factor_value(const TrialFactor& factor) {
  Json value = {
      {"id", factor.id}, {"label", factor.label}, {"unit", factor.unit}, {"levels", Json::array()}};
  for (const double level : factor.levels) value["levels"].push_back(number_value(level));
  return value;
}

TrialFactor read_factor(const JsonCursor& value) {
  value.allow_only({"id", "label", "unit", "levels"});
  TrialFactor factor{.id = value.at("id").text(100),
                     .label = value.at("label").text(200),
                     .unit = value.at("unit").text(100),
                     .levels = {}};
  if (factor.id.empty()) value.at("id").fail("is empty");
  for (const JsonCursor& level : value.at("levels").elements(1, kMost))
    factor.levels.push_back(level.number(-kLargest, kLargest));
  return factor;
}

Json setup_value(const TrialSetup& setup) {
  Json value = {{"id", setup.id}, {"title", setup.title}, {"factors", Json::array()}};
  for (const TrialFactor& factor : setup.factors) value["factors"].push_back(factor_value(factor));
  return value;
}

/// Throws if an id stands twice among the items of an array.
template <typename Item>
void check_ids(const std::vector<Item>& items, const JsonCursor& array) {
  std::set<std::string> ids;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!ids.insert(items[i].id).second) array.element(i).at("id").fail("is there twice");
}

TrialSetup read_setup(const JsonCursor& value) {
  value.allow_only({"id", "title", "factors"});
  TrialSetup setup{
      .id = read_id(value.at("id")), .title = value.at("title").text(1000), .factors = {}};
  for (const JsonCursor& factor : value.at("factors").elements(0, kMostFactors))
    setup.factors.push_back(read_factor(factor));
  check_ids(setup.factors, value.at("factors"));
  return setup;
}

Json design_value(const TrialDesign& design) {
  Json value = {{"question", design.question},
                {"setups", Json::array()},
                {"series", Json::array()},
                {"quantities", Json::array()}};
  for (const TrialSetup& setup : design.setups) value["setups"].push_back(setup_value(setup));
  for (const TrialSeries& series : design.series)
    value["series"].push_back({{"id", series.id}, {"label", series.label}});
  for (const Quantity& quantity : design.quantities)
    value["quantities"].push_back(quantity_value(quantity));
  return value;
}

TrialDesign read_design(const JsonCursor& value) {
  value.allow_only({"question", "setups", "series", "quantities"});
  TrialDesign design;
  design.question = value.at("question").text(kLongestText);
  for (const JsonCursor& item : value.at("setups").elements(1, kMost))
    design.setups.push_back(read_setup(item));
  for (const JsonCursor& item : value.at("series").elements(1, kMost)) {
    item.allow_only({"id", "label"});
    design.series.push_back({.id = read_id(item.at("id")), .label = item.at("label").text(200)});
  }
  for (const JsonCursor& item : value.at("quantities").elements(1, kMost))
    design.quantities.push_back(read_quantity(item));
  check_ids(design.setups, value.at("setups"));
  check_ids(design.series, value.at("series"));
  check_ids(design.quantities, value.at("quantities"));
  return design;
}

Json trial_value(const Trial& trial) {
  Json value = {{"setup", trial.at.setup},
                {"series", trial.series},
                {"levels", Json::object()},
                {"values", Json::array()}};
  for (const Level& level : trial.at.levels)
    value["levels"][level.factor] = number_value(std::get<double>(level.value));
  for (const double number : trial.values) value["values"].push_back(number_value(number));
  if (!trial.statuses.empty()) value["statuses"] = statuses_value(trial.statuses);
  return value;
}

/// Throws unless the design has the trial's setup, levels and series.
void check_belongs(const Trial& trial, const JsonCursor& value, const TrialDesign& design) {
  const auto setup = std::ranges::find(design.setups, trial.at.setup, &TrialSetup::id);
  if (setup == design.setups.end()) value.at("setup").fail("the study has no such setup");
  const JsonCursor levels = value.at("levels");
  for (const TrialFactor& factor : setup->factors) {
    const auto found = std::ranges::find(trial.at.levels, factor.id, &Level::factor);
    if (found == trial.at.levels.end()) levels.fail("lacks the factor " + in_quotes(factor.id));
    if (std::ranges::find(factor.levels, std::get<double>(found->value)) == factor.levels.end())
      levels.at(factor.id).fail("the setup has no such level");
  }
  if (trial.at.levels.size() > setup->factors.size())
    levels.fail("has a factor that the setup does not have");
  if (std::ranges::find(design.series, trial.series, &TrialSeries::id) == design.series.end())
    value.at("series").fail("the study has no such series");
}

Trial read_trial(const JsonCursor& value, const TrialDesign* design) {
  value.allow_only({"setup", "series", "levels", "values", "statuses"});
  std::optional<std::size_t> quantities;
  if (design != nullptr) quantities = design->quantities.size();
  std::vector<Level> levels;
  for (const auto& [factor, level] : value.at("levels").members())
    levels.push_back({.factor = factor, .value = level.number(-kLargest, kLargest)});
  Trial trial{.at = condition(value.at("setup").text(), std::move(levels)),
              .series = value.at("series").text(),
              .values = value.at("values").numbers_or_null(-kLargest, kLargest, quantities),
              .statuses = {}};
  if (design != nullptr) check_belongs(trial, value, *design);
  if (const auto statuses = value.find("statuses")) trial.statuses = read_statuses(*statuses);
  return trial;
}

Json pair_value(const MeasuredPair& pair) {
  return {{"first", pair.first},
          {"second", pair.second},
          {"distance_m", pair.distance_m},
          {"precision", pair.precision},
          {"looks", pair.looks}};
}

MeasuredPair read_pair(const JsonCursor& value, Eigen::Index landmarks) {
  value.allow_only({"first", "second", "distance_m", "precision", "looks"});
  const auto last = static_cast<int>(landmarks) - 1;
  MeasuredPair pair;
  pair.first = value.at("first").integer32(0, last);
  pair.second = value.at("second").integer32(0, last);
  if (pair.first >= pair.second) value.at("second").fail("expected a row after the first");
  pair.distance_m = value.at("distance_m").number(0.0, kFarthest_m);
  pair.precision = value.at("precision").number(0.0, kLargest);
  pair.looks = value.at("looks").integer32(0, std::numeric_limits<int>::max());
  return pair;
}

/// [xx, xy, yy] a landmark, null for one without.
std::vector<Eigen::Matrix2d> read_covariances(const JsonCursor& array, std::size_t landmarks) {
  std::vector<Eigen::Matrix2d> covariances;
  for (const JsonCursor& item : array.elements(0, landmarks)) {
    Eigen::Matrix2d C = Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
    if (!item.is_null()) {
      const std::vector<double> entries = item.numbers_or_null(-kLargest, kLargest, 3);
      C << entries[0], entries[1], entries[1], entries[2];
    }
    covariances.push_back(C);
  }
  if (!covariances.empty() && covariances.size() != landmarks)
    array.fail("expected one a landmark, or none");
  return covariances;
}

Json map_value(const TrialMap& map) {
  Json value = {{"id", map.id}, {"title", map.title}, {"map", map_value(map.map)}};
  value["pairs"] = Json::array();
  for (const MeasuredPair& pair : map.pairs) value["pairs"].push_back(pair_value(pair));
  value["covariances"] = covariances_value(map.covariances);
  return value;
}

TrialMap read_trial_map(const JsonCursor& value) {
  value.allow_only({"id", "title", "map", "pairs", "covariances"});
  TrialMap map{.id = read_id(value.at("id")),
               .title = value.at("title").text(10'000),
               .map = read_map(value.at("map")),
               .pairs = {},
               .covariances = {}};
  const std::size_t landmarks = map.map.names.size();
  for (const JsonCursor& pair : value.at("pairs").elements(0, landmarks * landmarks))
    map.pairs.push_back(read_pair(pair, static_cast<Eigen::Index>(landmarks)));
  map.covariances = read_covariances(value.at("covariances"), landmarks);
  return map;
}

}  // namespace

std::string trial_study_json(const TrialStudy& study) {
  return json_text({{"schema", schema_value("mapproof.trial_study")},
                    {"experiment", trial_experiment_value(study.experiment)},
                    {"design", design_value(study.design)},
                    {"provenance", provenance_value(study.provenance)}});
}

TrialStudy parse_trial_study(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.trial_study");
  root.allow_only({"schema", "experiment", "design", "provenance"});
  TrialStudy study;
  study.experiment = read_trial_experiment(root.at("experiment"));
  study.design = read_design(root.at("design"));
  study.provenance = read_provenance(root.at("provenance"));
  return study;
}

std::string trial_part_json(const TrialPart& part, const std::string& digest) {
  Json value = {{"schema", schema_value("mapproof.trial_part")},
                {"id", part.id},
                {"run", part.run ? run_id_value(*part.run) : Json(nullptr)},
                {"digest", digest},
                {"trials", Json::array()},
                {"maps", Json::array()}};
  for (const Trial& trial : part.trials) value["trials"].push_back(trial_value(trial));
  for (const TrialMap& map : part.maps) value["maps"].push_back(map_value(map));
  return json_text(value);
}

ReadTrialPart parse_trial_part(std::string_view text, const std::string& source,
                               const TrialDesign* design) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.trial_part");
  root.allow_only({"schema", "id", "run", "digest", "trials", "maps"});
  ReadTrialPart read{.part = {}, .digest = root.at("digest").text(64)};
  read.part.id = root.at("id").text(200);
  if (!is_plain_id(read.part.id)) root.at("id").fail("expected letters a to z, digits and '-'");
  if (const JsonCursor run = root.at("run"); !run.is_null()) read.part.run = read_run_id(run);
  for (const JsonCursor& trial : root.at("trials").elements(0, 1'000'000))
    read.part.trials.push_back(read_trial(trial, design));
  for (const JsonCursor& map : root.at("maps").elements(0, kMost))
    read.part.maps.push_back(read_trial_map(map));
  check_ids(read.part.maps, root.at("maps"));
  return read;
}

}  // namespace mapproof
