#include "core/model/certificate.hpp"

namespace mapproof {

std::string_view name(SdpSolver solver) {
  return solver == SdpSolver::kLowRank ? "low_rank" : "csdp";
}

std::optional<SdpSolver> sdp_solver_named(std::string_view name_in_files) {
  for (const SdpSolver solver : {SdpSolver::kLowRank, SdpSolver::kCsdp})
    if (name(solver) == name_in_files) return solver;
  return std::nullopt;
}

}  // namespace mapproof
