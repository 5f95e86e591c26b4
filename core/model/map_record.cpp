#include "core/model/map_record.hpp"

#include <array>

namespace mapproof {
namespace {

constexpr std::array kNames = {std::string_view("truth"), std::string_view("similarity")};

}  // namespace

std::string_view name(Frame frame) { return kNames[static_cast<std::size_t>(frame)]; }

std::optional<Frame> frame_named(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (kNames[i] == name) return static_cast<Frame>(i);
  return std::nullopt;
}

std::string observed(const MapRecord& map) {
  return map.of_pairs ? "range and bearing" : std::string(name(map.sensor));
}

std::string made_by(const MapRecord& map) {
  return map.of_pairs ? "SMACOF of measured pairs" : label(map.setting);
}

}  // namespace mapproof
