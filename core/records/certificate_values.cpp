#include "core/records/certificate_values.hpp"

#include <cmath>

#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

/// null for infinity: no bound was proved.
Json finite_value(double number) { return std::isfinite(number) ? Json(number) : Json(nullptr); }

double read_finite(const JsonCursor& value, double least) {
  return value.is_null() ? kInfinity : value.number(least, kInfinity);
}

}  // namespace

Json certificate_value(const Certificate& certificate) {
  return {{"solver", name(certificate.solver)},
          {"primal", certificate.primal},
          {"dual", finite_value(certificate.dual)},
          {"relative_gap", finite_value(certificate.relative_gap)},
          {"constraint_residual", certificate.constraint_residual}};
}

Certificate read_certificate(const JsonCursor& value) {
  value.allow_only({"solver", "primal", "dual", "relative_gap", "constraint_residual"});
  const std::optional<SdpSolver> solver = sdp_solver_named(value.at("solver").text());
  if (!solver) value.at("solver").fail("expected interior_point, low_rank or csdp");
  return {.solver = *solver,
          .primal = value.at("primal").number(0.0, kInfinity),
          .dual = read_finite(value.at("dual"), -kInfinity),
          .relative_gap = read_finite(value.at("relative_gap"), 0.0),
          .constraint_residual = value.at("constraint_residual").number(0.0, kInfinity)};
}

}  // namespace mapproof
