#pragma once

#include <string>

#include "core/model/slam_study.hpp"
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

}  // namespace mapproof
