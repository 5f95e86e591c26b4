#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/range_slam/fit/log_evidence.hpp"
#include "core/range_slam/fit/log_problem.hpp"

namespace mapproof {

struct HeldOutRanges;
struct LogFit;
struct LogFitOptions;

/// Bounds of the drops, and what naming a hypothesis costs: those with a free time have more ways
/// to fit noise.
struct TestRule {
  FitCode code;
  double bound;
  double price;
};
inline constexpr std::array kTestRules = {
    TestRule{FitCode::kCommonOffset, 20.0, 0.0},   TestRule{FitCode::kLandmarkOffset, 13.0, 2.0},
    TestRule{FitCode::kTimeOffset, 20.0, 0.0},     TestRule{FitCode::kClockJump, 22.0, 4.0},
    TestRule{FitCode::kLandmarkMoved, 40.0, 10.0}, TestRule{FitCode::kIdsExchanged, 22.0, 4.0},
    TestRule{FitCode::kOdometryFrozen, 22.0, 0.0}};

inline const TestRule& rule_of(FitCode code) {
  return *std::ranges::find(kTestRules, code, &TestRule::code);
}

/// A hypothesis that was fitted.
struct TriedHypothesis {
  LogHypothesis hypothesis;
  LogProblem::Fit fit;
  double statistic = 0.0;

  double ratio() const { return statistic / rule_of(hypothesis.code).bound; }
};

inline constexpr Eigen::Index kLeastRanges = 3;  ///< Of a landmark with a position.

/// The plain fit (log_fit.cpp), the hypotheses compared with it (log_hypotheses.cpp), and the
/// verdict (log_verdict.cpp).
class LogTester {
 public:
  /// @param log, options  Must outlive the object.
  LogTester(const RangeLog& log, const LogFitOptions& options);

  LogFit run(const std::vector<SlamEstimate>& starts);

 private:
  std::optional<HeldOutRanges> held_out(const TriedHypothesis& cause) const;
  void place_landmarks();
  bool is_redundant() const;
  LogProblem make_problem(Eigen::Index keys, const std::vector<OdometryGap>& gaps) const;
  LogState state_of(const LogProblem& problem, const SlamEstimate& start) const;
  LogNoise first_noise(const LogProblem& problem, const LogState& start) const;
  LogProblem::Fit fit_plain(const LogProblem& problem,
                            const std::vector<SlamEstimate>& starts) const;
  void improve_plain();
  TriedHypothesis tried(LogHypothesis hypothesis, LogState start, LogNoise noise) const;
  double statistic_of(const LogProblem& problem, double plain_cost,
                      const LogProblem::Fit& fit) const;
  TriedHypothesis best_shift(const LogHypothesis& hypothesis,
                             const std::vector<LogState>& starts) const;
  std::vector<LogProblem::Fit> fits_of_parts(double before_s, double after_s) const;
  LogState joined(const LogProblem& problem, const std::vector<LogProblem::Fit>& parts,
                  double time_s) const;
  void update_times(LogHypothesis& hypothesis, const LogProblem::Fit& fit) const;
  /// The shifts of a clock at which the ranges cost least, the path held: lowest first, at most
  /// kMostTried, among multiples of `step_s` that grow apart.
  std::vector<double> likely_shifts(const LogHypothesis& hypothesis, LogProblem::Fit fit,
                                    double step_s) const;
  /// States with time offsets of up to a quarter of the log, at which a quarter of the ranges
  /// agrees best with the dead-reckoned path. Slopes do not lead to them.
  std::vector<LogState> starts_by_offset() const;
  void try_offsets();
  void try_times();
  void try_moves();
  void try_exchanges();
  /// Adds a fit to those that were tried, unless one of the same code and landmarks costs less.
  void keep_better(TriedHypothesis one);
  void try_frozen();
  void add_limits(const LogProblem::Scores& scores, std::vector<FitTest>& tests) const;
  FitCause cause_of(const TriedHypothesis& tried) const;
  double effect_of(const TriedHypothesis& tried) const;
  void judge(LogFit& result);
  void judge_gaps(Fit& fit) const;
  void judge_known(Fit& fit) const;
  void take_best(LogFit& result) const;
  void find_open_parts(Fit& fit) const;
  void finish(LogFit& result) const;
  SlamEstimate estimate_of(const LogProblem& problem, const LogProblem::Fit& fit) const;
  /// Which of LogNoise is given: way, heading by way and by turning, ranges.
  std::array<bool, 4> given() const;
  std::string named(Eigen::Index landmark) const {
    return log_.landmarks[static_cast<std::size_t>(landmark)];
  }

  const RangeLog& log_;
  const LogFitOptions& options_;
  Trajectory odometry_;
  std::vector<OdometryGap> gaps_;
  std::vector<bool> is_placed_;
  std::optional<LogProblem> problem_;
  LogProblem::Fit plain_;
  double inflation_ = 1.0;
  double speed_ = 0.0;                   ///< m/s, of the odometry.
  std::vector<LogProblem::Fit> halves_;  ///< Of the ranges of each half of the log alone; or none.
  std::vector<TriedHypothesis> tried_;
};

}  // namespace mapproof
