#include <gtest/gtest.h>

#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "render/plot/figure_json.hpp"
#include "render/scene/scene_json.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/samples/sample_scenes.hpp"
#include "tests/support/schemas/drawing_schemas.hpp"
#include "tests/support/schemas/schema_problem.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(DrawingSchemas, AreThoseOfTheCode) {
  for (const auto& [name, text] : drawing_schemas())
    EXPECT_EQ(read_file(fs::path(MAPPROOF_SOURCE_DIR) / "docs/schemas" / name), text)
        << "cmake --build build --target write_schemas";
}

TEST(DrawingSchemas, HoldForEveryFigureAndScene) {
  for (const Figure& figure : sample_figures())
    EXPECT_EQ(schema_problem("figure", json::parse(figure_to_json(figure))), "") << figure.id;
  for (const Scene& scene : sample_scenes())
    EXPECT_EQ(schema_problem("scene", json::parse(scene_to_json(scene))), "") << scene.id;
}

TEST(FigureJson, GivesTheBytesThatEarlierVersionsWrote) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(MAPPROOF_BASELINES)) {
    if (entry.path().extension() != ".json") continue;
    const std::string text = read_file(entry.path());
    EXPECT_EQ(figure_to_json(figure_from_json(text, entry.path().string())), text) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 20);
}

/// Whether the reader takes what the schema takes.
void expect_both_refuse(const std::string& schema, const json& bad) {
  EXPECT_NE(schema_problem(schema, bad), "") << bad.dump();
  if (schema == "figure")
    EXPECT_THROW(figure_from_json(bad.dump(), "f"), IoError) << bad.dump();
  else
    EXPECT_THROW(scene_from_json(bad.dump(), "s"), IoError) << bad.dump();
}

/// With the value at the pointer replaced, or without its key.
json damaged(json value, const std::string& pointer, const json& by) {
  const json::json_pointer position(pointer);
  if (by.is_null())
    value[position.parent_pointer()].erase(position.back());
  else
    value[position] = by;
  return value;
}

TEST(DrawingSchemas, RefuseWhatTheReaderRefuses) {
  const json figure = json::parse(figure_to_json(sample_figures().front()));
  for (const auto& [pointer, by] :
       std::vector<std::pair<std::string, json>>{{"/schema", nullptr},
                                                 {"/id", nullptr},
                                                 {"/panels", nullptr},
                                                 {"/id", "../x"},
                                                 {"/colour", "red"},
                                                 {"/panels", json::array()},
                                                 {"/panels/0/layers/0/kind", "pie"},
                                                 {"/panels/0/layers/0/label", nullptr},
                                                 {"/panels/0/x/limits", {1, 2, 3}},
                                                 {"/panels/0/x/scale", "square"},
                                                 {"/columns", -1}})
    expect_both_refuse("figure", damaged(figure, pointer, by));
  const json scene = json::parse(scene_to_json(sample_scenes().front()));
  for (const auto& [pointer, by] :
       std::vector<std::pair<std::string, json>>{{"/views", json::array()},
                                                 {"/views/0/camera/aspect", 9},
                                                 {"/views/0/camera/eye", {1, 2}},
                                                 {"/parts/0/style/opacity", 0},
                                                 {"/parts/0/style/colour", "gold"},
                                                 {"/parts/0/tones", nullptr}})
    expect_both_refuse("scene", damaged(scene, pointer, by));
}

}  // namespace
}  // namespace mapproof::test
