// mapproof_scenes_bench write FOLDER                 the scene, for the other programs as well
// mapproof_scenes_bench draw FOLDER SAMPLES COUNT SINCE   PNG images of 1200 x 900, the eye a
//     little farther round for each; SINCE: when the program was started, seconds of the epoch.
//     Prints "mapproof SAMPLES FIRST_S FURTHER_S".
// mapproof_scenes_bench repeat COUNT                 draws all samples COUNT times, for a look at
//     memory
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "render/image/png.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/scene_json.hpp"
#include "render/scene_client/scene_client.hpp"
#include "tests/support/samples/sample_scenes.hpp"

namespace {

using namespace mapproof;
namespace fs = std::filesystem;

constexpr int kWidth = 1200, kHeight = 900;
constexpr double kStep_rad = 0.05;

/// Of a time in seconds of the epoch.
double seconds_since(double since) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count() - since;
}

Scene bench_scene() {
  for (Scene& scene : test::sample_scenes())
    if (scene.id == "world-usual") return std::move(scene);
  return {};
}

void turn(Camera& camera) {
  const Point3 arm = camera.eye - camera.target;
  camera.eye = camera.target + Eigen::AngleAxisd(kStep_rad, Point3::UnitZ()) * arm;
}

void draw(const fs::path& folder, int samples, int count, double since) {
  Scene scene = scene_from_json(read_file(folder / "scene.json"), "scene.json");
  SceneClient client(MAPPROOF_SCENES_PROGRAM);
  double first = 0.0;
  for (int i = 0; i < count; ++i) {
    const Image image =
        client.draw(scene, scene_request(0, kWidth, kHeight, samples, report_theme()));
    write_file(folder / fmt::format("mapproof-{}-{}.png", samples, i), encode_png(image, {}));
    if (i == 0) first = seconds_since(since);
    turn(scene.views[0].camera);
  }
  std::printf("mapproof %d %.4f %.4f\n", samples, first,
              (seconds_since(since) - first) / std::max(count - 1, 1));
}

void repeat(int count) {
  SceneClient client(MAPPROOF_SCENES_PROGRAM);
  const std::vector<Scene> scenes = test::sample_scenes();
  for (int i = 0; i < count; ++i)
    client.draw(scenes[static_cast<std::size_t>(i) % scenes.size()],
                scene_request(0, 320 + 16 * (i % 5), 240, 4 * (i % 2), report_theme()));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "write" && argc == 3)
    write_file(fs::path(argv[2]) / "scene.json", scene_to_json(bench_scene()));
  else if (command == "draw" && argc == 6)
    draw(argv[2], std::atoi(argv[3]), std::atoi(argv[4]), std::atof(argv[5]));
  else if (command == "repeat" && argc == 3)
    repeat(std::atoi(argv[2]));
  else
    return 2;
  return 0;
}
