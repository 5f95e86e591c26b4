#include "core/model/slam/slam.hpp"

#include <array>
#include <utility>

namespace mapproof {
namespace {

constexpr std::array<std::pair<Alignment, std::string_view>, 4> kAlignmentNames{{
    {Alignment::kNone, "none"},
    {Alignment::kRigid, "rigid"},
    {Alignment::kRigidWithReflection, "rigid-with-reflection"},
    {Alignment::kSimilarity, "similarity"},
}};

}  // namespace

std::string_view name(Alignment alignment) {
  for (const auto& [value, text] : kAlignmentNames)
    if (value == alignment) return text;
  return {};
}

}  // namespace mapproof
