#include "core/experiment/external_input.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/experiment/seeds.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

Eigen::MatrixXd external_input(const ObservationHistory& history, int steps, ExternalInput input) {
  switch (input) {
    case ExternalInput::kDistances: {
      Eigen::MatrixXd distances = proximities(history, steps).squared_distances.cwiseSqrt();
      for (const Eigen::Index i : unseen_landmarks(history, steps)) {
        distances.row(i).setConstant(kInfinity);
        distances.col(i).setConstant(kInfinity);
        distances(i, i) = 0.0;
      }
      return distances;
    }
    case ExternalInput::kFeatures:
      return features(history, steps).values;
    case ExternalInput::kHistory:
      return history.values.leftCols(steps);
  }
  throw InvalidInput("unknown input of a method");
}

std::string checkpoint_id(const RunId& run, Sensor sensor, int steps) {
  return fmt::format("{}/{}/{}", slug(run), name(sensor), steps);
}

std::uint64_t checkpoint_seed(std::uint64_t seed, const RunId& run, Sensor sensor, int steps) {
  constexpr int kUnusedBits = 11;  // 53 are exact in JSON of any language.
  return derive_seed(seed,
                     {kExternalMap, static_cast<std::uint64_t>(run.layout),
                      static_cast<std::uint64_t>(run.pose), static_cast<std::uint64_t>(sensor),
                      static_cast<std::uint64_t>(steps)}) >>
         kUnusedBits;
}

}  // namespace mapproof
