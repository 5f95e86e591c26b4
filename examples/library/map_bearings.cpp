// map_bearings BEARINGS ANCHORS: the map of bearings by SMACOF, in the frame of the anchors.
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "core/embed/embedder.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/observations.hpp"
#include "core/score/map_score.hpp"

using namespace mapproof;

int main(int count, char** arguments) {
  if (count != 3) return std::fputs("usage: map_bearings BEARINGS ANCHORS\n", stderr), 2;
  try {
    const ObservationSource source = read_observations(arguments[1], Sensor::kBearing);
    const ObservationHistory& history = source.history;
    EmbedderOptions options;  // SMACOF goes on to the minimum, as that of `mapproof map` does.
    options.smacof = {.relative_fall = 1e-10, .max_iterations = 20'000};
    HistoryEmbedder embedder(history, history.steps(), options);
    const Embedding map = embedder.embed({Method::kSmacofKnn, 7});

    // The anchors by their rows in the history.
    const NamedPoints given = read_landmarks(arguments[2]);
    std::map<std::string, Eigen::Index> rows;
    for (Eigen::Index row = 0; row < history.landmarks(); ++row)
      rows[history.names[static_cast<std::size_t>(row)]] = row;
    Points anchors_m = Points::Zero(history.landmarks(), 2);
    std::vector<Eigen::Index> anchors;
    for (std::size_t i = 0; i < given.names.size(); ++i) {
      anchors.push_back(rows.at(given.names[i]));
      anchors_m.row(anchors.back()) = given.positions_m.row(static_cast<Eigen::Index>(i));
    }
    const AlignedMap aligned =
        align_to_anchors(map.coordinates, anchors_m, anchors, AffineFit::kLeastDistances);
    for (Eigen::Index row = 0; row < history.landmarks(); ++row)
      std::printf("%s,%.3f,%.3f\n", history.names[static_cast<std::size_t>(row)].c_str(),
                  aligned.positions_m(row, 0), aligned.positions_m(row, 1));
    return aligned.aligned ? 0 : 3;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "map_bearings: %s\n", error.what()), 2;
  }
}
