#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "reports/diff/images/image_diff.hpp"
#include "tests/support/images/foreign_pairs.hpp"

namespace mapproof::test {
namespace {

int channel(std::uint32_t pixel, int c) { return static_cast<int>((pixel >> (8 * c)) & 0xFF); }

TEST(ForeignImages, PairsThatNoReaderCanTellApartPass) {
  const std::vector<HarmlessPair> pairs = harmless_pairs();
  std::map<std::string, int> plots;
  for (const HarmlessPair& pair : pairs) {
    ++plots[pair.plot];
    const PixelDiff found = pixel_diff(pair.baseline, pair.current).pixels;
    EXPECT_GT(found.differing, 0) << pair.plot;
    EXPECT_EQ(found.changed, 0) << pair.plot;
  }
  EXPECT_GE(plots.size(), 7U);
}

TEST(ForeignImages, WhateverIsPlantedOnFlatGroundIsFoundAndSoIsItsLoss) {
  const std::vector<HarmlessPair> pairs = harmless_pairs();
  Random random(22);
  int promised = 0;
  for (int round = 0; round < 2000; ++round) {
    const HarmlessPair& pair = pairs[round % pairs.size()];
    const Planting planting = random_planting(random);
    const int contrast = static_cast<int>(random.uniform(12.0, 120.0));
    const PixelBox place = flat_place(pair, planting, random);
    if (place.width == 0 || !is_promised(planting, contrast)) continue;
    ++promised;
    const bool is_lost = random.uniform() < 0.5;
    const Image marked = planted(is_lost ? pair.baseline : pair.current, planting, place, contrast);
    const PixelDiff found = is_lost ? pixel_diff(marked, pair.current).pixels
                                    : pixel_diff(pair.baseline, marked).pixels;
    EXPECT_GT(found.changed, 0) << pair.plot << ": " << planting.name << " at " << place.x << ", "
                                << place.y << ", contrast " << contrast
                                << (is_lost ? ", lost" : "");
  }
  EXPECT_GT(promised, 1000);
}

/// The image through a Gaussian filter of that standard deviation, in a box.
Image blurred(const Image& image, double sigma_px, const PixelBox& box) {
  const int reach = static_cast<int>(std::ceil(4.0 * sigma_px));
  std::vector<double> weights;
  for (int step = -reach; step <= reach; ++step)
    weights.push_back(std::exp(-0.5 * step * step / (sigma_px * sigma_px)));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  Image out = image;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) {
      std::uint32_t colour = 0;
      for (int c = 0; c < 3; ++c) {
        double value = 0.0;
        for (int v = -reach; v <= reach; ++v)
          for (int u = -reach; u <= reach; ++u)
            value +=
                weights[v + reach] * weights[u + reach] *
                channel(image.row(std::clamp(
                            y + v, 0, image.height - 1))[std::clamp(x + u, 0, image.width - 1)],
                        c);
        colour |= static_cast<std::uint32_t>(std::lround(value / (sum * sum))) << (8 * c);
      }
      out.row(y)[x] = colour;
    }
  return out;
}

/// The image and what blur takes from it, once more.
Image unsharp_masked(const Image& image, const Image& blurred) {
  Image out = image;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    std::uint32_t colour = 0;
    for (int c = 0; c < 3; ++c)
      colour |= static_cast<std::uint32_t>(std::clamp(
                    2 * channel(image.pixels[i], c) - channel(blurred.pixels[i], c), 0, 255))
                << (8 * c);
    out.pixels[i] = colour;
  }
  return out;
}

TEST(ForeignImages, BlurOfAllOrOfAPartAndSharpeningAreFound) {
  for (const HarmlessPair& pair : harmless_pairs()) {
    const Image& image = pair.baseline;
    const PixelBox whole{0, 0, image.width, image.height};
    const PixelBox part{image.width / 4, image.height / 4, image.width / 2, image.height / 2};
    for (const PixelBox& box : {whole, part})
      for (const double sigma_px : {0.7, 1.0, 2.0}) {
        const Image soft = blurred(image, sigma_px, box);
        const Image sharp = unsharp_masked(image, soft);
        const std::string name = fmt::format("{}, {} px, {}", pair.plot, sigma_px, box.width);
        EXPECT_GT(pixel_diff(image, soft).pixels.changed, 0) << name;
        // Without anti-aliasing there is nothing to sharpen.
        if (box != whole || sharp.pixels == image.pixels) continue;
        EXPECT_GT(pixel_diff(image, sharp).pixels.changed, 0) << name;
      }
  }
}

/// Normal noise in each channel, rounded to levels.
Image noisy(Image image, double sigma, Random& random) {
  for (std::uint32_t& pixel : image.pixels) {
    std::uint32_t colour = 0;
    for (int c = 0; c < 3; ++c)
      colour |=
          static_cast<std::uint32_t>(std::clamp(
              channel(pixel, c) + static_cast<int>(std::lround(sigma * random.normal())), 0, 255))
          << (8 * c);
    pixel = colour;
  }
  return image;
}

TEST(ForeignImages, NoiseOfLessThanOneLevelPasses) {
  Random random(9);
  for (const HarmlessPair& pair : harmless_pairs())
    for (const double sigma : {0.3, 0.6, 0.9}) {
      const Image other = noisy(pair.baseline, sigma, random);
      EXPECT_EQ(pixel_diff(pair.baseline, other).pixels.changed, 0) << pair.plot << " " << sigma;
    }
}

/// Two sets of tolerances, the second at least as large as the first in each.
std::pair<ImageOptions, ImageOptions> widened_options(Random& random) {
  const auto pair = [&](double largest) {
    const double a = largest * std::pow(random.uniform(), 3),
                 b = largest * std::pow(random.uniform(), 3);
    return std::pair{std::min(a, b), random.uniform() < 0.3 ? std::min(a, b) : std::max(a, b)};
  };
  ImageOptions small, large;
  std::tie(small.noise, large.noise) = pair(20.0);
  std::tie(small.mean_noise, large.mean_noise) = pair(5.0);
  std::tie(small.displacement_px, large.displacement_px) = pair(2.5);
  std::tie(small.changed_share, large.changed_share) = pair(0.01);
  return {small, large};
}

TEST(ForeignImages, ALargerToleranceFailsNothingThatASmallerOnePasses) {
  const std::vector<HarmlessPair> pairs = harmless_pairs();
  Random random(7);
  int passed = 0, failed = 0;
  for (int round = 0; round < 60; ++round) {
    HarmlessPair pair = pairs[round % pairs.size()];
    if (round % 3 != 0) {  // Noise, and something planted that may be small.
      const double level = random.uniform(0.0, 6.0);
      for (std::uint32_t& pixel : pair.current.pixels) {
        const auto change = static_cast<int>(std::lround(level * random.normal()));
        std::uint32_t colour = 0;
        for (int c = 0; c < 3; ++c)
          colour |= static_cast<std::uint32_t>(std::clamp(channel(pixel, c) + change, 0, 255))
                    << (8 * c);
        pixel = colour;
      }
    }
    const auto [small, large] = widened_options(random);
    const PixelDiff strict = pixel_diff(pair.baseline, pair.current, small).pixels;
    const PixelDiff lenient = pixel_diff(pair.baseline, pair.current, large).pixels;
    (strict.changed > 0 ? failed : passed) += 1;
    EXPECT_LE(lenient.changed, strict.changed)
        << pair.plot << ": noise " << small.noise << " and " << large.noise << ", mean "
        << small.mean_noise << " and " << large.mean_noise << ", displacement "
        << small.displacement_px << " and " << large.displacement_px;
  }
  EXPECT_GT(passed, 1);
  EXPECT_GT(failed, 20);
}

}  // namespace
}  // namespace mapproof::test
