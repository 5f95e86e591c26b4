#pragma once

#include <cstddef>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/choice/judged_maps.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// What `--method auto` compared, and by what it picked.
struct MethodChoice {
  std::vector<JudgedMap> maps;     ///< All candidates.
  Criterion criterion;             ///< That the pick is the best by.
  std::vector<std::size_t> order;  ///< Rows of `maps` that gave a map, best first.
};

/// Judges the usual candidates for the first `steps` observations, by the criterion that picks best
/// with anchors, or without.
/// @param options  Its settings are filled in here.
MethodChoice choose_method(const ObservationHistory& history, Eigen::Index steps,
                           const CertaintyFrame& frame, ChoiceOptions options);

/// The ranking as a table, and in words what was done.
Section choice_section(const MethodChoice& choice);

/// The same for --json: criterion, and method, parameter and values of each candidate.
nlohmann::ordered_json choice_json(const MethodChoice& choice);

}  // namespace mapproof
