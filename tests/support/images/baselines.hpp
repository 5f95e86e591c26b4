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

/// How a baseline of a scene is stored: with a palette where its colours fit, for the sake of the
/// checkout.
std::string baseline_png(const Image& image);

/// Compares an image with tests/baselines/NAME.png and with each NAME@KEY.png, the same image as
/// other versions of Cairo, FreeType or Mesa draw it. An image that is like none of them is left in
/// the build's folder `visual/differing` as NAME.png, for people to look at.
/// @return Empty if the image is like one of them, else what differs from each.
std::string difference_from_baseline(const std::string& name, const Image& image);

}  // namespace mapproof::test
