#include "core/model/slam.hpp"

#include <array>
#include <utility>

namespace mapproof {
namespace {

constexpr std::array<std::pair<Alignment, std::string_view>, 4> kAlignmentNames{{
    {Alignment::kNone, "none"},
    {Alignment::kRigid, "rigid"},
    {Alignment::kRigidWithReflection, "rigid-with-reflection"},
    {Alignment::kSimilarity, "similarity"},
}};

}  // namespace

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

std::string_view name(Alignment alignment) {
  for (const auto& [value, text] : kAlignmentNames)
    if (value == alignment) return text;
  return {};
}

}  // namespace mapproof
