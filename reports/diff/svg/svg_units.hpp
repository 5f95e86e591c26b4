#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "reports/diff/svg/svg_tree.hpp"

namespace mapproof {

/// How many pixels (1/96 inch) a user unit is long when a file is drawn in its own size, by
/// element: viewBox and size of the root, and transforms. A root without a size counts one a unit.
struct SvgUnits {
  std::vector<double> outer;  ///< Where the element is placed: its transform moves it by these.
  std::vector<double> inner;  ///< Within it: of its own geometry and of its children.
};

SvgUnits svg_units(const SvgTree& tree);

/// How two transforms differ.
struct TransformDistance {
  double shift = 0.0;   ///< User units, by which the origin is placed elsewhere.
  double linear = 0.0;  ///< The largest difference of the four numbers that turn and scale.
};

/// Empty if one is not a list of transforms; no text is the identity.
std::optional<TransformDistance> transform_distance(std::string_view a, std::string_view b);

}  // namespace mapproof
