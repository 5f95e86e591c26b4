#pragma once

#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

struct RankedMethod {
  std::string label;
  double mean_rank = 1.0;  ///< 1 is best.
};

struct CriticalDifferenceSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::vector<RankedMethod> methods;  ///< In any order.
  double critical_difference = 0.0;   ///< Of mean ranks, Nemenyi's [nemenyi1963].
  double alpha = 0.05;
  int units = 0;  ///< That the methods were ranked on.
  std::string unit = "layout";
  double friedman_p = 1.0;  ///< Of no difference at all.
  std::vector<std::string> record_ids;
};

/// The critical-difference diagram [demsar2006, fig. 1]: methods at their mean ranks, the best to
/// the left; thick bars join those that do not differ. An arrow stands for a critical
/// difference longer than the axis, with a note.
/// @throws InvalidInput unless ranks are finite and in 1 to the number of methods, the critical
///         difference is positive and there are at most 30 methods.
Figure critical_difference_figure(const CriticalDifferenceSpec& spec);

}  // namespace mapproof
