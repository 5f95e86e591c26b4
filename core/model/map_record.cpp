#include "core/model/map_record.hpp"

#include <algorithm>
#include <array>

namespace mapproof {
namespace {

constexpr std::array kFrameNames = {std::string_view("truth"), std::string_view("similarity")};

}  // namespace

std::string_view name(Frame frame) { return kFrameNames[static_cast<std::size_t>(frame)]; }

std::optional<Frame> frame_named(std::string_view name) {
  for (std::size_t i = 0; i < kFrameNames.size(); ++i)
    if (kFrameNames[i] == name) return static_cast<Frame>(i);
  return std::nullopt;
}

bool is_anchor(const MapRecord& map, Eigen::Index row) {
  return std::ranges::find(map.anchors, row) != map.anchors.end();
}

std::string observed(const MapRecord& map) {
  return map.of_pairs ? "range and bearing" : std::string(name(map.sensor));
}

std::string made_by(const MapRecord& map) {
  return map.of_pairs ? "SMACOF of measured pairs" : label(map.setting);
}

}  // namespace mapproof
