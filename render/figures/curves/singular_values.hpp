#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// Singular values of one matrix of squared ranges.
struct SingularValues {
  std::string title;
  std::vector<double> values;         ///< Descending, >= 0.
  std::size_t rank = 4;               ///< How many are kept.
  std::optional<double> noise_level;  ///< What noise alone reaches.
};

struct SingularValuesSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::vector<SingularValues> panels;  ///< Those without values are left out.
  std::vector<std::string> record_ids;
};

/// Singular values on a logarithmic axis, those kept filled, and the noise floor: the level given,
/// or else the greatest value that is dropped. Ratios of the last one kept to it are in the titles.
/// @throws InvalidInput if a value is negative or infinite.
Figure singular_values_figure(const SingularValuesSpec& spec);

}  // namespace mapproof
