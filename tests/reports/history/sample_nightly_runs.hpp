#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "reports/history/history_store.hpp"
#include "reports/history/nightly_run.hpp"

namespace mapproof::test {

/// What a simulated nightly run does to a method's values, as factors.
struct Plant {
  std::map<std::string, double> error = {};    ///< By method.
  std::map<std::string, double> seconds = {};  ///< By method.
  double all_seconds = 1.0;
  double memory = 1.0;
  double error_noise = 0.0;     ///< Of each run, standard deviation of the logarithm.
  double seconds_noise = 0.05;  ///< Of each piece.
  double nightly_noise = 0.05;  ///< Of a nightly run, shared by all its seconds.
};

/// A nightly run of one study: six methods, 5 layouts x 5 poses, one step; noise by `seed`.
NightlyRun sample_nightly_run(int number, std::uint64_t seed, const Plant& plant = {});

/// Judges a nightly run by those that the store holds and appends it. @return With verdict and
/// findings.
NightlyRun judged(HistoryStore& store, NightlyRun nightly_run);

}  // namespace mapproof::test
