// Processor seconds of semidefinite embeddings, ours beside CSDP's, on simulated observations.
//   mapproof_sde_bench M...   a table row for each M, sensor and K; CSDP up to M = 500
#include <cmath>
#include <cstdlib>
#include <ctime>

#include <fmt/format.h>

#include "core/embed/sde/sde.hpp"
#include "tests/support/samples/observed.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

constexpr int kSteps = 2000;
constexpr int kMostLandmarksForCsdp = 500;

struct Timed {
  Embedding map;
  double seconds = 0.0;
};

Timed timed(const Eigen::MatrixXd& distances, int neighbours, SdpSolver solver) {
  const std::clock_t start = std::clock();
  Timed result{.map = sde(distances, {.neighbours = {.neighbours = neighbours}, .solver = solver})};
  result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return result;
}

void row(int landmarks, Sensor sensor, int neighbours) {
  const Eigen::MatrixXd D =
      test::observed_distances(landmarks, sensor, kSteps, static_cast<std::uint64_t>(landmarks));
  const Timed own = timed(D, neighbours, SdpSolver::kInteriorPoint);
  const Certificate& certificate = own.map.certificate.value();
  fmt::print("{:5} {:10} {:3} {:14} {:9.4f} {:8.1e} {:8.1e}", landmarks, name(sensor), neighbours,
             name(certificate.solver), own.seconds, certificate.relative_gap,
             certificate.constraint_residual);
  if (landmarks <= kMostLandmarksForCsdp) {
    const Timed other = timed(D, neighbours, SdpSolver::kCsdp);
    const double objective = other.map.certificate.value().primal;
    const double size = other.map.coordinates.rowwise().norm().maxCoeff();
    fmt::print(" {:9.4f} {:6.1f} {:9.1e} {:9.1e}", other.seconds, other.seconds / own.seconds,
               std::abs(certificate.primal - objective) / objective,
               test::procrustes_gap(other.map.coordinates, own.map.coordinates) / size);
  }
  fmt::print("\n");
}

}  // namespace
}  // namespace mapproof

int main(int count, char** arguments) {
  using namespace mapproof;
  fmt::print(
      "    M sensor       K by               seconds      gap residual   CSDP s  ratio objective "
      "      map\n");
  for (int i = 1; i < count; ++i)
    for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing})
      for (const int neighbours : {4, 7, 10})
        if (std::atoi(arguments[i]) <= 50 || neighbours == 7)
          row(std::atoi(arguments[i]), sensor, neighbours);
}
