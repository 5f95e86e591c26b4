#include "reports/diff/item_diff.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/scene/scene_json.hpp"
#include "tests/support/samples/sample_scenes.hpp"

namespace mapproof::test {
namespace {

FigureDiff diff_of(const Scene& a, const Scene& b) {
  SceneWords words;
  return scene_diff({scene_to_json(a), "a"}, {scene_to_json(b), "b"}, {}, words);
}

TEST(SceneDiff, FindsNothingInTheSameScene) {
  for (const Scene& scene : sample_scenes()) EXPECT_TRUE(diff_of(scene, scene).equal) << scene.id;
}

TEST(SceneDiff, DistinguishesDataFromStyleAndTexts) {
  const auto kind_after = [](const std::function<void(Scene&)>& change) {
    Scene scene = sample_scenes()[0];
    change(scene);
    const FigureDiff diff = diff_of(sample_scenes()[0], scene);
    EXPECT_EQ(diff.changes.size(), 1U);
    return diff.changes.at(0).kind;
  };
  EXPECT_EQ(kind_after([](Scene& s) { s.title += " again"; }), ChangeKind::kMetadata);
  EXPECT_EQ(kind_after([](Scene& s) { s.caption += " MPE 0.2 m."; }), ChangeKind::kData);
  EXPECT_EQ(kind_after([](Scene& s) { s.record_ids.emplace_back("another"); }), ChangeKind::kData);
  EXPECT_EQ(kind_after([](Scene& s) { s.views[0].camera.eye.x() += 1.0; }), ChangeKind::kStyle);
  EXPECT_EQ(kind_after([](Scene& s) {
              s.notes.push_back({"A note", ThemeColour::kText});
            }),
            ChangeKind::kStyle);
  EXPECT_EQ(kind_after([](Scene& s) {
              std::visit(
                  [](auto& part) {
                    if constexpr (requires { part.points; }) part.points[0].x() += 0.5;
                    if constexpr (requires { part.at; }) part.at[0].x() += 0.5;
                    if constexpr (requires { part.to; }) part.to[0].x() += 0.5;
                  },
                  s.parts[0]);
            }),
            ChangeKind::kData);
  EXPECT_EQ(kind_after([](Scene& s) {
              std::visit([](auto& part) { part.style.opacity *= 0.5; }, s.parts[0]);
            }),
            ChangeKind::kStyle);
}

TEST(SceneDiff, IsOfAnyTwoScenesWhicheverKeysTheyHave) {
  const std::vector<Scene> scenes = sample_scenes();
  for (const Scene& a : scenes)
    for (const Scene& b : scenes) EXPECT_EQ(diff_of(a, b).equal, &a == &b) << a.id << ", " << b.id;
  // What only one side writes is a change in both directions.
  const auto with_label = [&](const std::string& label) {
    Scene scene = scenes[0];
    std::visit([&](auto& part) { part.label = label; }, scene.parts[0]);
    return scene;
  };
  for (const auto& [a, b] : {std::pair("", "a label"), std::pair("a label", "")}) {
    const FigureDiff diff = diff_of(with_label(a), with_label(b));
    ASSERT_EQ(diff.changes.size(), 1U);
    EXPECT_EQ(diff.changes[0].what, "label");
    EXPECT_EQ(diff.changes[0].baseline, a);
    EXPECT_EQ(diff.changes[0].current, b);
  }
}

TEST(SceneDiff, ShowsOfTwoNumbersWhereTheyDiffer) {
  Scene scene = sample_scenes()[0];
  std::visit(
      [](auto& part) {
        if constexpr (requires { part.points; }) part.points[0].x() = 1.19917;
        if constexpr (requires { part.at; }) part.at[0].x() = 1.19917;
        if constexpr (requires { part.to; }) part.to[0].x() = 1.19917;
      },
      scene.parts[0]);
  Scene other = scene;
  std::visit(
      [](auto& part) {
        if constexpr (requires { part.points; }) part.points[0].x() = 1.199172;
        if constexpr (requires { part.at; }) part.at[0].x() = 1.199172;
        if constexpr (requires { part.to; }) part.to[0].x() = 1.199172;
      },
      other.parts[0]);
  const FigureDiff diff = diff_of(scene, other);
  ASSERT_EQ(diff.changes.size(), 1U);
  EXPECT_EQ(diff.changes[0].baseline, "1.19917");
  EXPECT_EQ(diff.changes[0].current, "1.199172");
}

TEST(SceneDiff, NamesAFileThatIsNotAScene) {
  SceneWords words;
  EXPECT_THROW(scene_diff({"{}", "a"}, {"{}", "b"}, {}, words), IoError);
}

}  // namespace
}  // namespace mapproof::test
