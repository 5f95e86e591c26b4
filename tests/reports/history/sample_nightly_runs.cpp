#include "tests/reports/history/sample_nightly_runs.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "reports/history/judge_nightly_run.hpp"

namespace mapproof::test {
namespace {

constexpr std::array kMethods = {"hessian-lle-K8", "isomap-K6", "lle-K6",
                                 "lpca",           "sde-K4",    "smacof"};

double factor(const std::map<std::string, double>& factors, const std::string& method) {
  const auto found = factors.find(method);
  return found == factors.end() ? 1.0 : found->second;
}

}  // namespace

NightlyRun sample_nightly_run(int number, std::uint64_t seed, const Plant& plant) {
  NightlyRun nightly_run{
      .facts = {.number = number,
                .started_utc = fmt::format("2026-01-01T00:{:02}:{:02}Z", number / 60, number % 60),
                .ended_utc = fmt::format("2026-01-01T00:{:02}:{:02}Z", number / 60, number % 60),
                .command = "mapproof nightly sample",
                .provenance = "{}",
                .host = "host",
                .processor = "x86_64",
                .cores = 2,
                .jobs = 2}};
  NightlyStudy study{
      .name = "sample", .kind = "mapproof.study", .experiment_digest = "d", .runs = 25};
  // What a run scores is the same in every nightly run; noise is the nightly run's own.
  Random same(1);
  Random random(derive_seed(seed, {static_cast<std::uint64_t>(number)}));
  const double busy = plant.all_seconds * std::exp(plant.nightly_noise * random.normal());
  study.seconds = 100.0 * busy;
  study.peak_memory_mib = 80.0 * plant.memory * std::exp(0.005 * random.normal());
  for (const char* method : kMethods) {
    const double level = same.uniform(0.05, 0.3);
    for (int layout = 1; layout <= 5; ++layout)
      for (int pose = 1; pose <= 5; ++pose) {
        const std::string run = fmt::format("layout-{}-pose-{}", layout, pose);
        const std::string unit = fmt::format("layout-{}", layout);
        const double noise = std::exp(plant.error_noise * random.normal());
        const double mpe =
            level * std::exp(0.3 * same.normal()) * factor(plant.error, method) * noise;
        const double seconds = 0.02 * busy * factor(plant.seconds, method) *
                               std::exp(plant.seconds_noise * random.normal());
        study.scores[{"bearing", method, 2000, "mpe_m"}].push_back({run, unit, mpe});
        study.scores[{"bearing", method, 2000, "seconds"}].push_back({run, unit, seconds});
      }
  }
  nightly_run.studies.push_back(std::move(study));
  return nightly_run;
}

NightlyRun judged(HistoryStore& store, NightlyRun nightly_run) {
  judge_nightly_run(store, nightly_run, std::nullopt);
  store.append(nightly_run);
  return nightly_run;
}

}  // namespace mapproof::test
