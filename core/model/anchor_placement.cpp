#include "core/model/anchor_placement.hpp"

#include <array>
#include <cstddef>

namespace mapproof {
namespace {

constexpr std::array kPlacementNames = {std::string_view("walls"), std::string_view("random"),
                               std::string_view("cluster")};

}  // namespace

std::string_view name(AnchorPlacement placement) {
  return kPlacementNames[static_cast<std::size_t>(placement)];
}

}  // namespace mapproof
