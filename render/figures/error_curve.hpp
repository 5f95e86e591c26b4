#pragma once

#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// One method's error over steps. All four vectors are as long as each other; NaN: nothing known.
struct Curve {
  std::string label;          ///< In the legend.
  std::vector<double> steps;  ///< Ascending, number of observations.
  std::vector<double> mean;   ///< Over runs.
  std::vector<double> low;    ///< Of the 95 % band; empty, with `high`: no band.
  std::vector<double> high;
  std::string key;  ///< [a-z0-9-]+, unique in the figure; ids of marks are made of it.
};

struct ErrorCurveSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string y_label = "MPE [m]";
  std::string quantity = "mean position error";  ///< In words, for the alt text.
  std::vector<Curve> curves;                     ///< Up to ten are told apart.
  std::string caption;                           ///< Empty: one is made.
  std::vector<std::string> record_ids;
};

/// Mean error over steps, a line with a 95 % band for each curve; log y if the span is large.
/// @throws InvalidInput if a curve's vectors disagree in length or a key is no id or there twice.
Figure error_curve_figure(const ErrorCurveSpec& spec);

}  // namespace mapproof
