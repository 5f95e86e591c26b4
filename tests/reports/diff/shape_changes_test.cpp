#include "reports/diff/images/pixel_judgement.hpp"

#include <gtest/gtest.h>

namespace mapproof::test {
namespace {

constexpr int kAcross = 20;
constexpr double kAllowed = 0.35;

/// A tile of which no movement explains more than a half.
TileEvidence reshaped() {
  TileEvidence tile;
  tile.beyond_noise = 20;
  tile.kept.left = 0.5;
  return tile;
}

/// Ten tiles in the middle of 20 x 20 that differ; content is everywhere.
class ShapeChanges : public ::testing::Test {
 protected:
  ShapeChanges() {
    for (int i = 0; i < 10; ++i) {
      tiles.push_back(10 * kAcross + 5 + i);
      evidence.push_back(reshaped());
    }
    texture.tiles = kAcross * kAcross;
    texture.bounds = {0, 0, kAcross - 1, kAcross - 1};
  }
  void move(int count, double right_px, double left = 0.05) {
    for (int i = 0; i < count; ++i) evidence[i].kept = {left, right_px, 0.0};
  }
  /// As hinting of titles and labels does.
  void reach_out() {
    for (const int tile : {5, 10 * kAcross, 19 * kAcross + 5}) {
      tiles.push_back(tile);
      evidence.push_back(reshaped());
    }
  }
  long changed(double allowed_px = kAllowed) const {
    return std::ranges::count(shape_changes(tiles, evidence, texture, kAcross, allowed_px), true);
  }

  std::vector<int> tiles;
  std::vector<TileEvidence> evidence;
  Texture texture;
};

TEST_F(ShapeChanges, ShapesThatMovedFarAreNotHinting) {
  reach_out();
  move(6, 2.0);
  EXPECT_EQ(changed(), 6);
  EXPECT_EQ(changed(2.0), 0);
}

TEST_F(ShapeChanges, SomeThatMovedFarMayBeHintingWhereDifferencesExtendAsFarAsText) {
  move(3, 2.0);
  EXPECT_EQ(changed(), 3);
  reach_out();
  EXPECT_EQ(changed(), 0);
}

TEST_F(ShapeChanges, AlignmentToWholePixelsMovesInOneDirection) {
  move(6, 1.0, 0.0);
  EXPECT_EQ(changed(), 0);
  move(3, -1.0, 0.0);
  EXPECT_EQ(changed(), 6);
}

TEST_F(ShapeChanges, DifferentShapesAreFoundAmongThoseInPlace) {
  move(9, 0.1);
  evidence[9].left_share = evidence[9].kept.left = 0.95;
  evidence[9].bold = 15;
  EXPECT_EQ(changed(), 1);
  move(9, 0.1, 0.5);
  EXPECT_EQ(changed(), 0);
}

TEST_F(ShapeChanges, NoTilesGiveNoChanges) {
  EXPECT_TRUE(shape_changes({}, {}, {}, 0, kAllowed).empty());
}

}  // namespace
}  // namespace mapproof::test
