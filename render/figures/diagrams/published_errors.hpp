#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// A method's error, ours and as published.
struct PublishedError {
  std::string label;              ///< "SMACOF, kNN weights".
  std::string key;                ///< [a-z0-9-]+, unique in the panel.
  double mean_m = 0.0;            ///< Ours, > 0; others are left out.
  std::optional<Range> interval;  ///< 95 % interval of our mean [m].
  std::optional<double> published_m;
};

struct PublishedErrorsSpec {
  struct Sensor {
    std::string title;   ///< "Visibility maps".
    std::string source;  ///< "Yairi 2007, Table 1".
    std::vector<PublishedError> methods;
  };
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::vector<Sensor> sensors;
  std::vector<std::string> record_ids;
};

/// A panel per sensor: each method's mean error with its interval, and the published one, on a
/// logarithmic axis, least error uppermost. The title counts the published errors within our
/// intervals.
Figure published_errors_figure(const PublishedErrorsSpec& spec);

}  // namespace mapproof
