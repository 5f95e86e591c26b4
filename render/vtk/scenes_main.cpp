#include <malloc.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/out_of_memory.hpp"
#include "core/base/parent_watch.hpp"
#include "render/scene/scene_json.hpp"
#include "render/scene/scene_request.hpp"
#include "render/vtk/scene_renderer.hpp"

namespace mapproof {
namespace {

constexpr int kUsage = 2;
constexpr int kNoContext = 3;
constexpr int kNoMemory = 4;

void answer(const SceneReply& reply, const Image* image) {
  const std::string line = reply_to_line(reply);
  std::fwrite(line.data(), 1, line.size(), stdout);
  if (image != nullptr)
    std::fwrite(image->pixels.data(), sizeof(image->pixels[0]), image->pixels.size(), stdout);
  std::fflush(stdout);
}

/// The last scene, which is often drawn in several views and colours.
struct LastScene {
  std::string line;
  Scene scene;

  const Scene& of(const std::string& scene_line) {
    if (scene_line != line) {
      scene = scene_from_json(scene_line, "scene");
      line = scene_line;
    }
    return scene;
  }
};

/// Answers one request with its image, or with the reason why the scene cannot be drawn.
void serve(SceneRenderer& renderer, const std::string& request_line, const std::string& scene_line,
           LastScene& last) {
  try {
    const SceneRequest request = request_from_line(request_line, "request");
    const Image image = renderer.draw(last.of(scene_line), request);
    answer({"", image.width, image.height, renderer.name()}, &image);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    answer({.error = error.what()}, nullptr);
  }
}

int run() {
  std::string request, scene;
  std::unique_ptr<SceneRenderer> renderer;
  LastScene last;
  while (std::getline(std::cin, request)) {
    if (!std::getline(std::cin, scene)) {
      std::fputs("mapproof-scenes: a request without its scene\n", stderr);
      return kUsage;
    }
    try {
      if (!renderer) renderer = std::make_unique<SceneRenderer>();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      answer({.error = error.what()}, nullptr);
      std::fprintf(stderr, "mapproof-scenes: %s\n", error.what());
      return kNoContext;
    }
    serve(*renderer, request, scene, last);
  }
  return 0;
}

}  // namespace
}  // namespace mapproof

/// Keeps the memory of freed images for the next one: new pages cost more time than drawing does.
static void keep_memory() {
#ifdef __GLIBC__
  constexpr int kLargestBlock = 32 << 20;  // All that mallopt takes.
  constexpr int kKept = 256 << 20;
  ::mallopt(M_MMAP_THRESHOLD, kLargestBlock);
  ::mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

/// Reads requests, each one line (see SceneRequest) and one line of a scene, and answers each with
/// one line (see SceneReply) and raw pixels. mapproof starts it; it is not meant for direct use.
int main() {
  mapproof::end_with_parent();
  keep_memory();
  mapproof::pin_driver();
  std::ios::sync_with_stdio(false);
  std::cin.exceptions(std::ios::badbit);  // Want of memory for a line must not look like the end.
  try {
    return mapproof::run();
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "mapproof-scenes: %s\n", mapproof::kOutOfMemory);
    return mapproof::kNoMemory;
  }
}
