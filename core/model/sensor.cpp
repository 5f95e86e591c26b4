#include "core/model/sensor.hpp"

#include <array>

namespace mapproof {
namespace {

constexpr std::array kSensorNames = {std::string_view("visibility"), std::string_view("bearing"),
                                     std::string_view("range")};

}  // namespace

std::string_view name(Sensor sensor) { return kSensorNames[static_cast<std::size_t>(sensor)]; }

std::optional<Sensor> sensor_named(std::string_view name) {
  for (std::size_t i = 0; i < kSensorNames.size(); ++i)
    if (kSensorNames[i] == name) return static_cast<Sensor>(i);
  return std::nullopt;
}

}  // namespace mapproof
