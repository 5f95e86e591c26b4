#pragma once

#include <vector>

#include "core/pairs/pair_solution.hpp"

namespace mapproof {

/// The best of what several starts come to, the first of those that are about as good: the map that
/// most scans agree with, by what they measured and by the way round that they show landmarks.
/// Folds that distances alone leave are taken back.
/// @param turns  In the problem's rows; may be empty.
PairSolution searched(PairProblem& problem, const std::vector<SeenTurn>& turns,
                      const PairMapOptions& options);

}  // namespace mapproof
