#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/model/fit.hpp"
#include "core/model/map_record.hpp"
#include "core/model/map_uncertainty.hpp"
#include "core/model/sensor.hpp"
#include "render/plot/figure.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// A part of a result that a step of the pipeline contributes, by its name.
template <typename Value>
struct NamedPart {
  std::string name;
  Value value;
};

/// What is known of a thing, in words: {"Landmarks", "50"}, ...
using Facts = std::vector<std::pair<std::string, std::string>>;

/// A map, what map.json holds of it, and the remarks of the steps that made it.
struct MapResult {
  MapRecord record;
  std::optional<MapUncertainty> uncertainty = {};  ///< If ellipses were asked for.
  std::optional<MapSensors> sensors = {};      ///< If it is of several sensors.
  Fit fit = {};                                ///< Of the data to the map.
  Facts read = {};                             ///< Of the observations.
  Facts facts = {};                            ///< For the head of the report.
  std::vector<std::string> remarks = {};
  std::vector<std::string> warnings = {};  ///< What a person should know before trusting the map.
  std::vector<Section> sections = {};      ///< Of the report, after the landmarks.
  std::vector<Figure> figures = {};        ///< Besides the map's own, below it.
  /// Members of the result of --json; "data_association" is an empty list unless a step gives it.
  std::vector<NamedPart<nlohmann::ordered_json>> members = {};
  std::vector<NamedPart<std::string>> files = {};  ///< In the folder, besides the map's own.
};

}  // namespace mapproof
