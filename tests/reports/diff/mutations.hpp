#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/image/image.hpp"
#include "render/plot/drawing.hpp"
#include "reports/diff/images/image_diff.hpp"
#include "tests/reports/diff/styles.hpp"

namespace mapproof::test {

using Change = std::function<void(Drawing&)>;

/// The last digit of an item's text becomes another.
Change other_digit(std::size_t item, int by);

/// Two images of which the second has one thing mutated, and the expected verdict.
struct Mutation {
  std::string name;
  std::string image;
  ImageState expected = ImageState::kDifferent;
  std::function<Image()> baseline, current;
};

/// Everything that can be mutated in a drawing, one thing at a time.
std::vector<Mutation> mutations_of(const Drawing& drawing, const std::string& image);

/// Those that are hardest to see: thicker lines, grids of pale dots, curves through fewer points,
/// one change while all is moved by a tenth of a pixel; and different hinting of text, which is
/// not a change.
std::vector<Mutation> subtle_mutations_of(const Drawing& drawing, const std::string& image);

/// Many shapes that moved, in different directions or together, smoothly or by whole pixels, alone
/// and with a changed digit.
std::vector<Mutation> moved_mutations_of(const Drawing& drawing, const std::string& image);

/// Sample figures at several sizes and themes, thick lines and thin.
std::vector<std::pair<std::string, Drawing>> mutable_drawings();

}  // namespace mapproof::test
