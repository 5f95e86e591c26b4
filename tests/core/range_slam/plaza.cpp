#include "tests/core/range_slam/plaza.hpp"

#include <cstdlib>
#include <filesystem>
#include <limits>

#include "core/range_slam/dead_reckoning.hpp"
#include "core/records/range_log_files.hpp"
#include "core/score/trajectory_error.hpp"

namespace mapproof::test {
std::optional<Plaza> plaza(const std::string& name) {
  const char* folder = std::getenv("MAPPROOF_PLAZA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  Plaza plaza;
  plaza.log = read_range_log(std::filesystem::path(folder) / name);
  plaza.odometry = dead_reckoned(plaza.log);
  return plaza;
}

double mean_error_m(const Plaza& plaza, const SlamEstimate& estimate, Alignment alignment) {
  const auto error =
      trajectory_error(estimate, *plaza.log.truth, plaza.log.true_landmarks, alignment);
  return error ? error->mean_m : std::numeric_limits<double>::infinity();
}

}  // namespace mapproof::test
