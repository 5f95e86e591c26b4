#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "render/figures/curves/error_lines.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// A value of a parameter with the error there.
struct ParameterValue {
  double parameter = 0.0;
  double error = 0.0;  ///< NaN: not known; the line's own error there is taken.
};

/// One method's error over its parameter.
struct ParameterLine {
  ErrorLine line;                           ///< `x` holds the parameter.
  std::optional<ParameterValue> ours;       ///< Our optimum.
  std::optional<ParameterValue> published;  ///< The paper's, with the error that it printed.
};

/// The methods that are tuned by one kind of parameter.
struct ParameterGroup {
  std::string symbol;  ///< "K", "σ²", "d".
  std::string title;   ///< "neighbours K".
  Scale scale = Scale::kLinear;
  bool whole = true;  ///< The parameter is a whole number.
  std::vector<ParameterLine> methods;
};

struct ErrorByParameterSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string y_label = "MPE [m]";
  std::string quantity = "mean position error";
  std::vector<ParameterGroup> groups;
  double ceiling = std::numeric_limits<double>::infinity();  ///< As of ErrorLinesSpec.
  std::vector<std::string> record_ids;
};

/// The mean error of each method over its parameter with its 95 % band, a panel a kind of
/// parameter; our optimum and the paper's marked.
/// @throws InvalidInput as error_lines_figure.
Figure error_by_parameter_figure(const ErrorByParameterSpec& spec);

}  // namespace mapproof
