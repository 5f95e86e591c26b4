#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/not_finite.hpp"
#include "core/model/slam/slam_study.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// Error of each position over time, one line per record, with its mean and alignment in the
/// legend; as dots what the record's own covariances make one expect. The y axis is logarithmic if
/// the errors span much.
/// @return Empty if no record has errors.
std::optional<Panel> path_error_panel(std::span<const SlamRecord* const> records);

/// One sensor's or method's part: one line per layout of the anchors, `x` their number.
struct AnchorPanel {
  std::string title;
  std::vector<ErrorLine> placements;
};

struct AnchorCountSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string y_label = "MPE [m]";
  std::string quantity = "mean position error";
  std::vector<AnchorPanel> panels;
  std::vector<std::string> record_ids;
};

/// Error over the number of anchors, a line with its 95 % band a placement.
/// @throws InvalidInput as error_lines_figure.
Figure anchor_count_figure(const AnchorCountSpec& spec);

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
  double ceiling = kInfinity;  ///< As of ErrorLinesSpec.
  std::vector<std::string> record_ids;
};

/// The mean error of each method over its parameter with its 95 % band, one panel per kind of
/// parameter; our optimum and the paper's marked.
/// @throws InvalidInput as error_lines_figure.
Figure error_by_parameter_figure(const ErrorByParameterSpec& spec);

struct ErrorCurveSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string y_label = "MPE [m]";
  std::string quantity = "mean position error";  ///< In words, for the alt text.
  std::vector<ErrorLine> curves;                 ///< `x` holds the number of observations.
  std::string caption;                           ///< Empty: one is made.
  std::vector<std::string> record_ids;
};

/// Mean error over steps, a line with a 95 % band for each curve.
/// @throws InvalidInput as error_lines_figure.
Figure error_curve_figure(const ErrorCurveSpec& spec);

}  // namespace mapproof
