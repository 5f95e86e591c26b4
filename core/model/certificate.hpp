#pragma once

#include <optional>
#include <string_view>

namespace mapproof {

/// What solved a semidefinite program.
enum class SdpSolver {
  kInteriorPoint,  ///< Our own: a primal-dual interior point [helmberg1996].
  kLowRank,        ///< Our own: factors of low rank [burer2003], proved by its multipliers.
  kCsdp,           ///< CSDP, an interior-point method [borchers1999].
};

/// The name used in files ("interior_point", "low_rank", "csdp").
std::string_view name(SdpSolver solver);

/// The solver of that name; empty if there is none.
std::optional<SdpSolver> sdp_solver_named(std::string_view name);

/// How near the optimum a maximisation by semidefinite programming came, proved by its dual.
struct Certificate {
  SdpSolver solver = SdpSolver::kInteriorPoint;
  double primal = 0.0;        ///< The objective reached, in squared units of the data.
  double dual = 0.0;          ///< No feasible point's objective is above this; infinite: nothing
                              ///< was proved; below 0: that there is no feasible point.
  double relative_gap = 0.0;  ///< |dual - primal| / |dual|; 0 if both are 0.
  double constraint_residual = 0.0;  ///< Largest violation over the largest right-hand side.

  bool operator==(const Certificate&) const = default;
};

}  // namespace mapproof
