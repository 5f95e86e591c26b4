// draw_map FOLDER: the map of a simulated room by ISOMAP, as FOLDER/room.svg, .png and .pdf.
#include <cstdio>
#include <exception>

#include "core/base/random.hpp"
#include "core/embed/embedder.hpp"
#include "core/model/map_record.hpp"
#include "core/score/map_score.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"
#include "render/figures/maps/map.hpp"
#include "render/output/write_figure.hpp"

using namespace mapproof;

int main(int count, char** arguments) {
  if (count != 2) return std::fputs("usage: draw_map FOLDER\n", stderr), 2;
  try {
    // Seeds are arguments: the same seed gives the same room, walk and map.
    Random random(1);
    const World world = scatter_landmarks({}, random);
    const Path path = random_walk(world, {}, 400, random);
    const ObservationHistory history =
        observe(world, path, {.sensor = Sensor::kBearing}, random);
    const MethodSetting setting{Method::kIsomap, 9};
    const Embedding embedding = HistoryEmbedder(history, history.steps()).embed(setting);

    MapRecord map;
    map.id = "room";
    map.origin = FromSensor{Sensor::kBearing, setting};
    map.step = static_cast<int>(history.steps());
    map.names = history.names;
    map.ground_truth_m = world.landmarks_m;
    map.anchors = place_anchors(world, 4, AnchorPlacement::kWalls, random);
    map.estimate = align_to_anchors(embedding.coordinates, world.landmarks_m, map.anchors,
                                    AffineFit::kLeastDistances)
                       .positions_m;
    map.statuses = embedding.statuses;
    map.score = score_map(map.estimate, world.landmarks_m, map.anchors, AffineFit::kLeastDistances);
    write_figure(map_figure(map, "room"), report_theme(), arguments[1]);
    std::printf("mean position error %.3f m\n", map.score->mpe_m);
    return 0;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "draw_map: %s\n", error.what()), 2;
  }
}
