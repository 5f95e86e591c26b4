#include "core/model/certificate.hpp"

namespace mapproof {

std::string_view name(SdpSolver solver) {
  switch (solver) {
    case SdpSolver::kInteriorPoint:
      return "interior_point";
    case SdpSolver::kLowRank:
      return "low_rank";
    case SdpSolver::kCsdp:
      return "csdp";
  }
  return {};
}

std::optional<SdpSolver> sdp_solver_named(std::string_view name_in_files) {
  for (const SdpSolver solver : {SdpSolver::kInteriorPoint, SdpSolver::kLowRank, SdpSolver::kCsdp})
    if (name(solver) == name_in_files) return solver;
  return std::nullopt;
}

bool is_certified(const Certificate& certificate) {
  return certificate.relative_gap <= kCertifiedGap &&
         certificate.constraint_residual <= kCertifiedResidual;
}

}  // namespace mapproof
