#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/study.hpp"
#include "core/statistics/friedman.hpp"
#include "core/statistics/intervals.hpp"
#include "reports/sections/results/paired_methods.hpp"

namespace mapproof {

/// The methods of one sensor ranked by MPE, each at its best parameter; layouts are the units,
/// since runs in one layout are not independent. What a critical-difference diagram shows.
struct MethodRanks {
  std::vector<MethodSetting> methods;  ///< Those compared, in the order of the experiment.
  std::vector<Method> left_out;        ///< Without a score in some layout.
  std::vector<int> layouts;
  Eigen::MatrixXd
      mpe_m;  ///< One row per layout, one column per method; mean over poses that all have.

  std::optional<FriedmanTest> test;  ///< Empty with fewer than two layouts or methods.
  double alpha = kSignificanceOfMethods;
  double critical_difference = 0.0;     ///< Nemenyi's, of mean ranks; 0 without a test.
  std::vector<std::vector<int>> alike;  ///< Groups of `methods`, as alike_groups() gives them.
};

MethodRanks method_ranks(const Study& study, const SensorStudy& sensor,
                         double alpha = kSignificanceOfMethods);

/// The methods of one sensor, each at its best parameter, compared by MPE; layouts are the groups.
struct SensorComparison {
  std::vector<MethodSetting> settings;  ///< By the numbers of the methods in `paired`.
  std::optional<PairedMethods> paired;  ///< Empty where no two have a run in common.
};

SensorComparison compare_methods(const Study& study, const SensorStudy& sensor);

/// Which methods paired test and mean ranks judge otherwise, see paired_methods.hpp.
std::string disagreement_of(const SensorComparison& comparison);

/// "One method has a lower MPE than another", compared with the runs.
struct OrderingClaim {
  Method less = Method::kLpca;
  Method more = Method::kLpca;
  /// MPE of `more` less that of `less`, each at its best parameter, over the runs that both have:
  /// the claim holds if it is positive. Empty if one of them was not tried or never scored.
  std::optional<MeanEstimate> difference_m;
  int layouts = 0;        ///< With such runs.
  int layouts_where = 0;  ///< Of them, those where it holds in the mean.

  bool holds() const { return difference_m && difference_m->mean > 0.0; }
  /// Whether the interval of the difference leaves 0 out.
  bool is_significant() const;
};

/// Each neighbouring pair of the orderings that were published on `sensor`, once.
std::vector<OrderingClaim> ordering_claims(const Study& study, const SensorStudy& sensor);

}  // namespace mapproof
