#include "reports/sections/figures/map_walls.hpp"

#include <gtest/gtest.h>

#include "core/base/not_finite.hpp"

namespace mapproof::test {
namespace {

/// A map of two landmarks, the second of which is off by so much.
MapRecord map_off(double error_m, double moe_percent = 1.0) {
  MapRecord map;
  map.id = "map";
  map.names = {"a", "b"};
  map.frame = Frame::kGroundTruth;
  map.ground_truth_m = Points{{0.0, 0.0}, {1.0, 0.0}};
  map.estimate = Points{{0.0, 0.0}, {1.0 + error_m, 0.0}};
  Score score;
  score.mpe_m = error_m;
  score.moe_percent = moe_percent;
  map.score = score;
  return map;
}

std::vector<std::string> titles_of(const Figure& figure) {
  std::vector<std::string> titles;
  for (const Panel& panel : figure.panels)
    titles.push_back(panel.title.substr(0, panel.title.find('\n')));
  return titles;
}

TEST(MapWalls, HaveTheBestMapFirstAndUselessOnesLast) {
  const MapRecord good = map_off(0.1), fair = map_off(0.4), turned = map_off(0.2, 60.0);
  const auto walls = map_walls("s", {{"hall: A", &fair}, {"hall: B", &turned}, {"hall: C", &good}});
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].id, "s-world-1");
  EXPECT_EQ(titles_of(walls[0]), (std::vector<std::string>{"C", "A", "B (not usable)"}));
  EXPECT_EQ(walls[0].title,
            "hall: C is the best of the 3 maps drawn, 0.100 m off; 1 is not usable");
  EXPECT_TRUE(walls[0].shared_x && walls[0].shared_y) << "one scale";
}

TEST(MapWalls, CountTheMapsThatTheirTitleRanks) {
  const MapRecord good = map_off(0.1), turned = map_off(0.2, 60.0);
  std::vector<std::pair<std::string, const MapRecord*>> maps(15, {"hall: A", &good});
  const auto title = [&] { return map_walls("s", maps).at(0).title; };
  EXPECT_EQ(
      title(),
      "hall: A is the best of 15 maps, 12 of them drawn, 0.100 m off; the others in the order of "
      "their errors");
  maps[13].second = maps[14].second = &turned;
  EXPECT_TRUE(title().ends_with("; 2 are not usable")) << title();
  EXPECT_EQ(map_walls("s", maps)[0].panels.size(), 12U);
}

TEST(MapWalls, AreOfOneWorldEach) {
  const MapRecord one = map_off(0.1), two = map_off(0.2);
  MapRecord elsewhere = map_off(0.1);
  (*elsewhere.ground_truth_m)(1, 0) = 7.0;
  MapRecord alone = map_off(0.1);
  alone.names = {"a", "c"};
  const auto walls = map_walls("s", {{"hall: A", &one},
                                     {"hall: B", &two},
                                     {"hall: C", &elsewhere},
                                     {"hall: D", &alone},
                                     {"yard: A", &one},
                                     {"yard: B", &two}});
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_TRUE(walls[0].title.starts_with("hall: A is the best")) << walls[0].title;
  EXPECT_TRUE(walls[1].title.starts_with("yard: A is the best")) << walls[1].title;
  EXPECT_EQ(walls[0].panels.size(), 2U);
}

TEST(MapWalls, WithoutAUsableMapSaySo) {
  const MapRecord a = map_off(0.1, 50.0), b = map_off(0.2, 40.0);
  EXPECT_EQ(map_walls("s", {{"hall: A", &a}, {"hall: B", &b}}).at(0).title,
            "hall: no map is usable");
}

TEST(MapWalls, OfMapsWithoutAnErrorDoNotCallThemUnusable) {
  MapRecord unknown = map_off(0.1);
  unknown.score->mpe_m = unknown.score->moe_percent = kNaN;
  EXPECT_EQ(map_walls("s", {{"hall: A", &unknown}, {"hall: B", &unknown}}).at(0).title,
            "hall: maps of one world");
}

}  // namespace
}  // namespace mapproof::test
