#pragma once

#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "render/image/image.hpp"
#include "reports/diff/images/image_changes.hpp"

namespace mapproof::test {

/// Two images of one plot by one program, drawn in ways that no reader can tell apart.
struct HarmlessPair {
  std::string plot;
  Image baseline, current;
};

/// The pairs of tests/data/foreign_images, whose make.py draws them.
std::vector<HarmlessPair> harmless_pairs();

/// What is planted: the share of colour at each pixel, 0 to 255, row by row.
struct Planting {
  std::string name;
  int width = 0, height = 0;
  std::vector<int> cover;

  int at(int x, int y) const { return cover[static_cast<std::size_t>(y) * width + x]; }
};

/// A word, a number, a disc, a line or a block.
Planting random_planting(Random& random);

/// A random place for the planting that is flat in both images, with three pixels around; the width
/// is 0 if none was found.
PixelBox flat_place(const HarmlessPair& pair, const Planting& planting, Random& random);

/// The image with the planting, `contrast` of 255 darker, or lighter on a dark ground.
Image planted(Image image, const Planting& planting, const PixelBox& place, int contrast);

/// Whether docs/diff-images.md promises that the planting is found on flat ground.
bool is_promised(const Planting& planting, int contrast);

}  // namespace mapproof::test
