#pragma once

#include <string>
#include <vector>

#include "render/image/image.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof::test {

/// A small page: 480 x 360 pixels.
Theme baseline_theme();

/// The sample figures that differ most in what they show: those that have a baseline.
std::vector<Figure> baseline_figures();

/// Compares with tests/baselines/NAME.png. What is not alike, and what has no baseline, is left in
/// the build's folder `visual` as NAME.png, for people to look at.
/// @return Empty if the picture is as it was, else what differs.
std::string difference_from_baseline(const std::string& name, const Image& image);

}  // namespace mapproof::test
