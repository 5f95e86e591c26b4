#pragma once

#include <string>

#include "core/embed/sde/problem.hpp"

namespace mapproof::unfolding {

/// The most pairs for CSDP: its matrix of them squared takes 200 MB there.
inline constexpr Eigen::Index kMostCsdpPairs = 5000;

/// CSDP's result for a problem.
struct CsdpAnswer {
  Solution solution;
  int code = 0;  ///< CSDP's: 0 solved, 3 solved with reduced accuracy, others failed.
};

/// Solves by CSDP's library [borchers1999], without its prints and parameter file. The first point
/// is held at the origin, which leaves the feasible set an interior; centring follows.
/// @throws InvalidInput if there are no pairs or more than kMostCsdpPairs.
/// @note O(m^3) time an iteration and O(m^2) memory for m pairs. One call at a time: others wait.
CsdpAnswer solve_with_csdp(const Problem& problem);

}  // namespace mapproof::unfolding
