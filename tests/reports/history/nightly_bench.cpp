// Simulated histories judged one nightly run after the other: how often the rules cry wolf, and
// what they find. mapproof_nightly_bench [HISTORIES] [RUNS]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "reports/history/judge_nightly_run.hpp"
#include "tests/reports/history/sample_nightly_runs.hpp"

namespace mapproof {
namespace {

/// What is planted from one nightly run on.
struct Scenario {
  std::string name;
  std::function<test::Plant(int nightly_run, int from)> plant;
  std::string subject;  ///< That a right finding names; empty: none is right.
};

test::Plant noise() { return {.error_noise = 0.02}; }

std::vector<Scenario> scenarios() {
  const auto with = [](auto change) {
    return [change](int nightly_run, int from) {
      test::Plant plant = noise();
      if (nightly_run >= from) change(plant, nightly_run - from + 1);
      return plant;
    };
  };
  return {
      {"none", with([](test::Plant&, int) {}), ""},
      {"one nightly run twice as slow",
       with([](test::Plant& plant, int after) { plant.all_seconds = after == 1 ? 2.0 : 1.0; }), ""},
      {"error of one method +5 %", with([](test::Plant& plant, int) {
         plant.error = {{"lpca", 1.05}};
       }),
       "bearing, lpca"},
      {"error of one method +2 %", with([](test::Plant& plant, int) {
         plant.error = {{"lpca", 1.02}};
       }),
       "bearing, lpca"},
      {"error of one method +0.3 % a nightly run", with([](test::Plant& plant, int after) {
         plant.error = {{"lpca", std::pow(1.003, after)}};
       }),
       "bearing, lpca"},
      {"seconds of one method +20 %", with([](test::Plant& plant, int) {
         plant.seconds = {{"lpca", 1.2}};
       }),
       "bearing, lpca"},
      {"seconds of one method +0.6 % a nightly run", with([](test::Plant& plant, int after) {
         plant.seconds = {{"lpca", std::pow(1.006, after)}};
       }),
       "bearing, lpca"},
      {"all seconds +30 %", with([](test::Plant& plant, int) { plant.all_seconds = 1.3; }),
       kAllMethods},
      {"memory +10 %", with([](test::Plant& plant, int) { plant.memory = 1.1; }),
       "the whole study"},
  };
}

struct Tally {
  int nightly_runs = 0;        ///< Judged, without anything planted or before it.
  int false_nightly_runs = 0;  ///< Of them, with a finding.
  bool wrong = false;          ///< Something that was not planted was named at any time.
  int found_after = -1;        ///< Nightly runs from the plant to the first right finding.
  int dated_off = 0;           ///< Between the nightly run named and the right one.
};

/// One history in memory: the store's part in it is tested elsewhere.
Tally judge_history(const Scenario& scenario, std::uint64_t seed, int nightly_runs, int from) {
  Tally tally;
  StudyEvidence evidence;
  evidence.trend.name = "sample";
  std::vector<NightlyFinding> yesterday;
  std::optional<ReferenceScores> reference;
  for (int number = 1; number <= nightly_runs; ++number) {
    const NightlyRun nightly_run =
        test::sample_nightly_run(number, seed, scenario.plant(number, from));
    add_this_run(evidence.trend, nightly_run.facts, nightly_run.studies[0]);
    evidence.this_run = nightly_run.studies[0].scores;
    evidence.reference = reference;
    yesterday = judge_study(evidence, {}, yesterday).findings;
    evidence.trend.nightly_runs.back().verdict = verdict_of(yesterday);
    if (yesterday.empty()) reference = {number, nightly_run.studies[0].scores};
    const bool planted = !scenario.subject.empty() && number >= from;
    bool right = false;
    bool wrong = false;
    for (const NightlyFinding& finding : yesterday) {
      const bool is_right = planted && finding.subject.starts_with(scenario.subject);
      if (is_right && tally.found_after < 0) tally.dated_off = std::abs(finding.since - from);
      right = right || is_right;
      wrong = wrong || !is_right;
    }
    if (!planted) {
      ++tally.nightly_runs;
      tally.false_nightly_runs += wrong;
    }
    tally.wrong = tally.wrong || wrong;
    if (right && tally.found_after < 0) tally.found_after = number - from;
  }
  return tally;
}

void report(const Scenario& scenario, const std::vector<Tally>& tallies) {
  long nightly_runs = 0, false_nightly_runs = 0, wrong = 0, found = 0, same_nightly_run = 0;
  std::vector<int> delays, off;
  for (const Tally& tally : tallies) {
    nightly_runs += tally.nightly_runs;
    false_nightly_runs += tally.false_nightly_runs;
    wrong += tally.wrong;
    if (tally.found_after < 0) continue;
    ++found;
    same_nightly_run += tally.found_after == 0;
    delays.push_back(tally.found_after);
    off.push_back(tally.dated_off);
  }
  std::sort(delays.begin(), delays.end());
  std::sort(off.begin(), off.end());
  const double n = static_cast<double>(tallies.size());
  fmt::print("{:<38} {:>9.3f} {:>9.1f}", scenario.name,
             100.0 * static_cast<double>(false_nightly_runs) / static_cast<double>(nightly_runs),
             100.0 * static_cast<double>(wrong) / n);
  if (scenario.subject.empty())
    fmt::print("\n");
  else
    fmt::print(" {:>9.1f} {:>9.1f} {:>7} {:>7}\n", 100.0 * static_cast<double>(found) / n,
               100.0 * static_cast<double>(same_nightly_run) / n,
               delays.empty() ? -1 : delays[delays.size() / 2],
               off.empty() ? -1 : off[off.size() / 2]);
}

}  // namespace
}  // namespace mapproof

int main(int argc, char** argv) {
  using namespace mapproof;
  const int histories = argc > 1 ? std::atoi(argv[1]) : 1000;
  const int nightly_runs = argc > 2 ? std::atoi(argv[2]) : 40;
  const int from = nightly_runs / 2 + 1;
  fmt::print("{} histories of {} nightly runs, planted in nightly run {}\n", histories,
             nightly_runs, from);
  fmt::print("{:<38} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7}\n", "", "false", "histories", "found",
             "the same", "median", "run");
  fmt::print("{:<38} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7}\n", "planted", "a nightly run %",
             "with any %", "%", "nightly run %", "delay", "off by");
  for (const Scenario& scenario : scenarios()) {
    std::vector<Tally> tallies(static_cast<std::size_t>(histories));
    tbb::parallel_for(0, histories, [&](int i) {
      tallies[static_cast<std::size_t>(i)] =
          judge_history(scenario, 1000 + static_cast<std::uint64_t>(i), nightly_runs, from);
    });
    report(scenario, tallies);
    std::fflush(stdout);
  }
}
