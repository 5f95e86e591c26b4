#pragma once

#include <span>
#include <string>

#include "core/model/slam/slam_study.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct WindowCurveSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  const WindowCurve& windows;
  std::string record_id;
};

/// Error of ranges held out over the window length, the chosen one ringed; lengths that predict
/// nothing are crosses at the upper edge. No ground truth enters.
/// @throws InvalidInput if lengths and errors differ in number, or a length is not positive.
Figure window_curve_figure(const WindowCurveSpec& spec);

/// Error of the measurement model C-hat over the number of measurements, with 95 % bars and the
/// slope −1/2 of theory, together with the landmarks' error [boots2013, figure 1B].
Figure convergence_figure(const std::string& id, const ConvergenceCurve& curve);

/// The sine of the largest canonical angle between the learned subspace and the true one, with its
/// bound [boots2013, eq. 5], whose constant is fitted at the first point.
Figure subspace_angle_figure(const std::string& id, const ConvergenceCurve& curve);

/// Landmarks, which converge, and the robot's single positions, which do not.
Figure positions_figure(const std::string& id, const ConvergenceCurve& curve);

/// Error of C-hat and of the landmarks for each noise model.
Figure noise_models_figure(const std::string& id, std::span<const ConvergenceCurve> curves);

/// Seconds of the factorisation over T, a line for each N, and over N, a line for each T, with the
/// slopes of O((2N)^2 T) [boots2013, section 4]; varies from run to run.
Figure factorization_cost_figure(const std::string& id, std::span<const FactorizationCost> costs);

}  // namespace mapproof
