#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapproof {

/// The names of methods that are crossed with something else, as "Bearing, ISOMAP", taken apart.
struct CrossedNames {
  std::vector<std::string> firsts, seconds;  ///< Of all of the study, in its order, each once.
  std::vector<std::pair<std::size_t, std::size_t>> names;  ///< Both parts of each label.
};

/// Empty unless every label has two parts with a comma between, one second part stands behind
/// several first ones, and one first part before several second ones, with no more parts than
/// labels.
/// @param labels    Those that are shown.
/// @param of_study  All of the study, those shown among them.
std::optional<CrossedNames> crossed_names(const std::vector<std::string>& labels,
                                          const std::vector<std::string>& of_study);

}  // namespace mapproof
