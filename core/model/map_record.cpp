#include "core/model/map_record.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

constexpr std::array kPlacementNames = {std::string_view("walls"), std::string_view("random"),
                                        std::string_view("cluster")};

constexpr std::array kFrameNames = {std::string_view("ground_truth"),
                                    std::string_view("similarity")};

}  // namespace

std::string_view name(AnchorPlacement placement) {
  return kPlacementNames[static_cast<std::size_t>(placement)];
}

std::string_view name(Frame frame) { return kFrameNames[static_cast<std::size_t>(frame)]; }

bool is_anchor(const MapRecord& map, Eigen::Index row) {
  return std::ranges::find(map.anchors, row) != map.anchors.end();
}

const MethodSetting* setting_of(const MapRecord& map) {
  if (const auto* one = std::get_if<FromSensor>(&map.origin)) return &one->setting;
  if (const auto* several = std::get_if<FromSensors>(&map.origin)) return &several->setting;
  return nullptr;
}

std::string_view sensor_name(const MapRecord& map) {
  if (const auto* one = std::get_if<FromSensor>(&map.origin)) return name(one->sensor);
  if (std::holds_alternative<FromRanges>(map.origin)) return name(Sensor::kRange);
  return std::holds_alternative<FromPairs>(map.origin) ? kRangeBearing : kMixed;
}

std::string_view method_name(const MapRecord& map) {
  const MethodSetting* setting = setting_of(map);
  if (setting != nullptr) return info(setting->method).name;
  return std::holds_alternative<FromPairs>(map.origin) ? kPairs : kSpectralMap;
}

std::string sensor_label(const MapRecord& map) {
  if (std::holds_alternative<FromPairs>(map.origin)) return "range and bearing";
  const auto* several = std::get_if<FromSensors>(&map.origin);
  if (several == nullptr) return std::string(sensor_name(map));
  std::vector<std::string> names;
  for (const Sensor sensor : several->sensors) names.emplace_back(name(sensor));
  return listed(names, names.size());
}

std::string method_label(const MapRecord& map) {
  const MethodSetting* setting = setting_of(map);
  if (std::holds_alternative<FromPairs>(map.origin)) return "SMACOF of measured pairs";
  if (std::holds_alternative<FromRanges>(map.origin)) return "Spectral range-only map";
  return std::holds_alternative<FromSensors>(map.origin) ? "joint map begun by " + label(*setting)
                                                         : label(*setting);
}

}  // namespace mapproof
