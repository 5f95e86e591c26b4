#include "render/theme/palette.hpp"

#include <algorithm>
#include <cmath>

namespace mapproof {
namespace {

/// Ten equally spaced colours of viridis; between them straight lines differ by less than 3/255.
constexpr std::array<Colour, 10> kViridis = {
    colour(0x440154), colour(0x482878), colour(0x3E4A89), colour(0x31688E), colour(0x26838E),
    colour(0x1F9E89), colour(0x35B779), colour(0x6CCE59), colour(0xB4DE2C), colour(0xFDE725)};

}  // namespace

Colour viridis(double share) {
  if (!(share > 0.0)) return kViridis.front();
  const double position = std::min(share, 1.0) * (kViridis.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(position), kViridis.size() - 2);
  return mix(kViridis[below + 1], kViridis[below], position - static_cast<double>(below));
}

}  // namespace mapproof
