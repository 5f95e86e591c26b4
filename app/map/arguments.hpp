#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/map/observations.hpp"
#include "core/records/observations/landmarks_csv.hpp"

namespace mapproof {

/// What `mapproof map` was told.
struct MapArguments {
  std::string out;
  std::vector<std::string> with;       ///< Files of other sensors,
  std::vector<std::string> with_kind;  ///< and what each holds.
  std::string method;                  ///< Empty: isomap, or pairs of range and bearing.
  MapInput input;
  std::string layout = "auto";
  bool degrees = false;
  std::string anchors;
  std::string truth;
  std::string fit = "least-distances";
  std::optional<double> parameter;  ///< One of these four.
  std::optional<double> neighbours;
  std::optional<double> variance;
  std::optional<double> degree;
  std::optional<std::string> templates;
  bool follow = false;
  std::string every = "1s";
  MapOptions options;
};

/// Fills in what the words ask for: input, options and setting. Unless the file is followed, it is
/// opened, and looked into where nothing says what it holds.
/// @throws InvalidInput for what does not go together; IoError if the file cannot be read.
void settle(MapArguments& arguments);

}  // namespace mapproof
