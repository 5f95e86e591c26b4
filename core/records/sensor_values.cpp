#include "core/records/sensor_values.hpp"

#include "core/records/json_values.hpp"

namespace mapproof {

nlohmann::ordered_json sensors_value(const MapSensors& sensors) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SensorShare& one : sensors.sensors)
    list.push_back({{"sensor", name(one.sensor)},
                    {"reliability", one.reliability},
                    {"weight", one.weight},
                    {"share", one.share},
                    {"continuity", one.continuity}});
  return {{"sensors", std::move(list)}, {"continuity", sensors.continuity}, {"why", sensors.why}};
}

MapSensors read_sensors(const JsonCursor& value) {
  value.allow_only({"sensors", "continuity", "why"});
  MapSensors result;
  for (const JsonCursor& one : value.at("sensors").elements(1, 3)) {
    one.allow_only({"sensor", "reliability", "weight", "share", "continuity"});
    result.sensors.push_back({.sensor = read_sensor(one.at("sensor")),
                              .reliability = one.at("reliability").number(0.0, 1.0),
                              .weight = one.at("weight").number(0.0, 1.0),
                              .share = one.at("share").number(0.0, 1.0),
                              .continuity = one.at("continuity").number_or_null(-1e300, 1.0)});
  }
  result.continuity = value.at("continuity").number_or_null(-1e300, 1.0);
  result.why = value.at("why").text();
  return result;
}

}  // namespace mapproof
