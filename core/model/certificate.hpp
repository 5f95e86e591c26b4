#pragma once

#include <optional>
#include <string_view>

namespace mapproof {

/// What solved a semidefinite program.
enum class SdpSolver {
  kInteriorPoint,  ///< Our own: a primal-dual interior point [helmberg1996].
  kLowRank,        ///< Our own: factors of low rank [burer2003], certified by its multipliers.
  kCsdp,           ///< CSDP, an interior-point method [borchers1999].
};

/// The name used in files ("interior_point", "low_rank", "csdp").
std::string_view name(SdpSolver solver);

/// The solver of that name; empty if there is none.
std::optional<SdpSolver> sdp_solver_named(std::string_view name);

/// Up to here a relative gap and a constraint residual count as none.
inline constexpr double kCertifiedGap = 1e-6;
inline constexpr double kCertifiedResidual = 1e-6;

/// How near the optimum a maximisation by semidefinite programming came, certified by its dual.
struct Certificate {
  SdpSolver solver = SdpSolver::kInteriorPoint;
  double primal = 0.0;        ///< The objective reached, in squared units of the data.
  double dual = 0.0;          ///< No feasible point's objective is above this; below 0: there is no
                              ///< feasible point; infinite: nothing was certified.
  double relative_gap = 0.0;  ///< |dual - primal| / |dual|; infinite: nothing was certified.
  double constraint_residual = 0.0;  ///< Largest violation over the largest right-hand side.

  bool operator==(const Certificate&) const = default;
};

/// Whether the answer is feasible and optimal within the bounds above.
bool is_certified(const Certificate& certificate);

}  // namespace mapproof
