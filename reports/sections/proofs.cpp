#include "reports/sections/proofs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

/// A larger gap is not what these solvers stop at.
constexpr double kProved = 1e-6;

/// Sensor, method, parameter, solver.
using Kind = std::tuple<Sensor, Method, double, SdpSolver>;

struct Proofs {
  MethodSetting setting;
  int solves = 0;
  int proved = 0;
  double gap = 0.0;
  double residual = 0.0;
  std::string worst;  ///< Record of the largest gap.
};

using ProofsByKind = std::map<Kind, Proofs>;

std::string_view title_of_solver(SdpSolver solver) {
  switch (solver) {
    case SdpSolver::kInteriorPoint:
      return "interior point (ours)";
    case SdpSolver::kLowRank:
      return "low rank (ours)";
    case SdpSolver::kCsdp:
      return "CSDP";
  }
  return "";
}

void add(ProofsByKind& all, const RunId& run, const RunRecord& record) {
  const Certificate& certificate = *record.certificate;
  Proofs& proofs = all[{record.sensor, record.setting.method,
                        record.setting.parameter.value_or(0.0), certificate.solver}];
  proofs.setting = record.setting;
  ++proofs.solves;
  if (certificate.relative_gap <= kProved) ++proofs.proved;
  proofs.residual = std::max(proofs.residual, certificate.constraint_residual);
  if (!proofs.worst.empty() && certificate.relative_gap <= proofs.gap) return;
  proofs.gap = certificate.relative_gap;
  proofs.worst = record_id(run, record.sensor, record.setting, record.step);
}

ProofsByKind proofs_of(const Study& study) {
  ProofsByKind all;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records)
      if (record.certificate) add(all, run.id, record);
  return all;
}

std::string power(double value) {
  return std::isfinite(value) ? fmt::format("{:.1e}", value) : "no bound";
}

Table proofs_table(const ProofsByKind& all) {
  Table table{"proofs",
              "Semidefinite programs: how near the optimum",
              {{"Sensor", "", "", ""},
               {"Method", "", "", ""},
               {"Solver", "", "", "What gave the answer."},
               {"Solves", "", "", ""},
               {"Proved", "", "", "With a relative gap of at most 1e-6."},
               {"Largest gap", "", "", "|dual - primal| / dual."},
               {"Largest residual", "", "", "Violation of a constraint over the largest one."},
               {"Worst record", "", "", "That of the largest gap."}},
              {},
              {}};
  for (const auto& [kind, proofs] : all)
    table.rows.push_back(
        {{TextCell{title_of(std::get<0>(kind))}, TextCell{label(proofs.setting)},
          TextCell{std::string(title_of_solver(std::get<3>(kind)))},
          NumberCell{static_cast<double>(proofs.solves), 0},
          NumberCell{static_cast<double>(proofs.proved), 0}, TextCell{power(proofs.gap)},
          TextCell{power(proofs.residual)}, TextCell{proofs.worst, Emphasis::kData}},
         proofs.worst,
         false});
  return table;
}

}  // namespace

std::optional<Section> proofs_section(const Study& study) {
  const ProofsByKind all = proofs_of(study);
  if (all.empty()) return std::nullopt;
  std::map<SdpSolver, int> solved;
  int solves = 0;
  int proved = 0;
  double gap = 0.0;
  for (const auto& [kind, proofs] : all) {
    solved[std::get<3>(kind)] += proofs.solves;
    solves += proofs.solves;
    proved += proofs.proved;
    gap = std::max(gap, proofs.gap);
  }
  std::vector<std::string> by;
  for (const auto& [solver, count] : solved)
    by.push_back(fmt::format("{} by {}", count, title_of_solver(solver)));
  Section section{"proofs", "How the semidefinite programs are proved", {}};
  section.blocks.emplace_back(plain(fmt::format(
      "{} solved, {}. Each answer comes with an upper bound from its dual: {} of them lie within "
      "1e-6 of theirs, the largest relative gap is {}. Those of the variations are not counted.",
      counted(solves, "program"), listed(by, 3), proved, power(gap))));
  section.blocks.emplace_back(proofs_table(all));
  return section;
}

KeyValues certificate_items(const Certificate& certificate) {
  const auto item = [](std::string key, std::string value) {
    return KeyValues::Item{std::move(key), {std::move(value), Emphasis::kPlain}};
  };
  const std::string bound =
      std::isfinite(certificate.dual) ? fmt::format("{:.9g}", certificate.dual) : "none proved";
  return {{item("Solver", std::string(title_of_solver(certificate.solver))),
           item("Variance reached", fmt::format("{:.9g}", certificate.primal)),
           item("Upper bound proved", bound), item("Relative gap", power(certificate.relative_gap)),
           item("Largest violation of a constraint", power(certificate.constraint_residual))}};
}

}  // namespace mapproof
