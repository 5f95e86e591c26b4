#pragma once

#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// One method's distances, a pair of landmarks each.
struct ShepardPanel {
  std::string title;
  std::vector<double> observed;  ///< In the space of observations.
  std::vector<double> mapped_m;  ///< On the map; as many. Pairs with a NaN are left out.
};

struct ShepardSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string x_label = "observed distance";
  std::string y_label = "map distance [m]";
  std::vector<ShepardPanel> methods;
  std::vector<std::string> record_ids;
};

/// How well map distances follow the observed ones.
struct ShepardFit {
  std::size_t pairs = 0;     ///< With both distances known.
  double correlation = 0.0;  ///< Pearson's; NaN if a side does not vary.
  double slope = 0.0;        ///< Least-squares, through the origin: map over observed.
  double stress = 0.0;       ///< Root of sum (d - slope x)^2 / sum d^2; NaN if all d are 0.
};

/// @throws InvalidInput if there are not as many of both, or one is infinite or negative.
ShepardFit shepard_fit(const ShepardPanel& panel);

/// Map distance against observed distance, a small panel a method on shared axes; shaded by the
/// number of pairs where there are many; correlation and stress in the panel's title.
/// @throws InvalidInput as shepard_fit.
Figure shepard_figure(const ShepardSpec& spec);

}  // namespace mapproof
