#include "core/records/studies/slam_store.hpp"
#include "tests/core/records/slam_samples.hpp"
#include "tests/reports/diff/value_cases.hpp"

namespace mapproof::test {

void write_base_slam_study(const std::filesystem::path& folder) {
  StudyWriter store = StudyWriter(
      folder,
      study_start(small_slam_experiment(), {"0.1.0", "0123456789ab", std::string(64, 'c'), {}}));
  store.write(part_of(made_up_slam_run("drive"), {}));
  store.write(part_of(made_up_convergence("white")));
  store.write(part_of(made_up_histories()));
  store.write(part_of(made_up_space_run()));
}

}  // namespace mapproof::test
