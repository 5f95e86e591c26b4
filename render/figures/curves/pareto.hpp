#pragma once

#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// What a setting of a method costs and how far its maps are off.
struct CostedSetting {
  std::string label;
  double seconds = 0.0;  ///< A map, > 0.
  double mpe_m = 0.0;
};

struct ParetoSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string y_label = "MPE [m]";
  std::vector<CostedSetting> settings;  ///< Those with a NaN or without cost are left out.
  std::vector<std::string> record_ids;
};

/// The settings that no other beats in both, by ascending seconds: indices. Of equal ones the
/// first.
std::vector<std::size_t> pareto_front(const std::vector<CostedSetting>& settings);

/// Error against seconds a map, a point a setting, those on the front filled, named and joined.
/// Seconds differ from run to run: the figure is marked so.
/// @throws InvalidInput if a value is infinite or negative.
Figure pareto_figure(const ParetoSpec& spec);

}  // namespace mapproof
