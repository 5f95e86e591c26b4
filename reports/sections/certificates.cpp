#include "reports/sections/certificates.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <map>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

/// The solves that the table has rows for.
struct CertificateKind {
  Sensor sensor;
  Method method;
  double parameter;
  SdpSolver solver;

  auto operator<=>(const CertificateKind&) const = default;
};

struct Certificates {
  MethodSetting setting;
  int solves = 0;
  int certified = 0;
  double gap = 0.0;
  double residual = 0.0;
  std::string worst;  ///< Record of the largest gap.
};

using CertificatesByKind = std::map<CertificateKind, Certificates>;

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

void add(CertificatesByKind& all, const RunId& run, const RunRecord& record) {
  const Certificate& certificate = *record.certificate;
  Certificates& certificates = all[{record.sensor, record.setting.method,
                                    record.setting.parameter.value_or(0.0), certificate.solver}];
  certificates.setting = record.setting;
  ++certificates.solves;
  if (is_certified(certificate)) ++certificates.certified;
  certificates.residual = std::max(certificates.residual, certificate.constraint_residual);
  if (!certificates.worst.empty() && certificate.relative_gap <= certificates.gap) return;
  certificates.gap = certificate.relative_gap;
  certificates.worst = record_id(run, record.sensor, record.setting, record.step);
}

CertificatesByKind certificates_of(const Study& study) {
  CertificatesByKind all;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records)
      if (record.certificate) add(all, run.id, record);
  return all;
}

std::string gap_text(double gap) { return std::isfinite(gap) ? significant(gap, 2) : "no bound"; }

std::string residual_text(double residual) { return significant(residual, 2); }

/// As a number that a page writes with a power of ten, and a file as one.
Cell gap_cell(double gap) {
  return std::isfinite(gap) ? Cell(NumberCell{gap, 6}) : Cell(TextCell{gap_text(gap)});
}

std::string certified_gap_text() {
  return ten_to_the(static_cast<int>(std::lround(std::log10(kCertifiedGap))));
}

Table certificates_table(const CertificatesByKind& all) {
  Table table{
      "certificates",
      "Semidefinite programs: how near the optimum",
      {{"Sensor", "", "", ""},
       {"Method", "", "", ""},
       {"Solver", "", "", "The solver of the solution."},
       {"Solves", "", "", ""},
       {"Certified", "", "",
        fmt::format("With a relative gap and a residual of at most {}.", certified_gap_text())},
       {"Largest gap", "", "", "|dual - primal| / |dual|."},
       {"Largest residual", "", "", "Violation of a constraint over the largest one."},
       {"Worst record", "", "", "That of the largest gap."}},
      {},
      {}};
  for (const auto& [kind, certificates] : all)
    table.rows.push_back(
        {{TextCell{title_of(kind.sensor)}, TextCell{label(certificates.setting)},
          TextCell{std::string(title_of_solver(kind.solver))},
          NumberCell{static_cast<double>(certificates.solves), 0},
          NumberCell{static_cast<double>(certificates.certified), 0}, gap_cell(certificates.gap),
          NumberCell{certificates.residual, 6}, TextCell{certificates.worst, Emphasis::kData}},
         certificates.worst,
         false});
  return table;
}

}  // namespace

std::optional<Section> certificates_section(const Study& study) {
  const CertificatesByKind all = certificates_of(study);
  if (all.empty()) return std::nullopt;
  std::map<SdpSolver, int> solved;
  int solves = 0;
  int certified = 0;
  double gap = 0.0;
  double residual = 0.0;
  for (const auto& [kind, certificates] : all) {
    solved[kind.solver] += certificates.solves;
    solves += certificates.solves;
    certified += certificates.certified;
    gap = std::max(gap, certificates.gap);
    residual = std::max(residual, certificates.residual);
  }
  std::vector<std::string> by;
  for (const auto& [solver, count] : solved)
    by.push_back(fmt::format("{} by {}", count, title_of_solver(solver)));
  Section section{
      "certificates", "Certificates of the semidefinite programs", {}, "", Interest::kFew};
  section.blocks.emplace_back(plain(fmt::format(
      "{} solved, {}. Each solution has an upper bound from its dual. Feasible and optimal to "
      "within {}: {} of them; the largest relative gap is {}, the largest residual {}. Those of "
      "the variations are not counted.",
      counted(solves, "program"), listed(by, 3), certified_gap_text(), certified, gap_text(gap),
      residual_text(residual))));
  section.blocks.emplace_back(certificates_table(all));
  return section;
}

Section certificate_section(const Certificate& certificate) {
  const auto item = [](std::string key, std::string value) {
    return KeyValues::Item{std::move(key), {std::move(value), Emphasis::kPlain}};
  };
  std::string bound = fmt::format("{:.9g}", certificate.dual);
  if (!std::isfinite(certificate.dual)) bound = "none certified";
  if (certificate.dual < 0.0) bound = "below 0: no points have the distances to be kept";
  Section section{"certificate", "Certificate of the map", {}};
  section.blocks.emplace_back(plain(
      is_certified(certificate)
          ? "No other map that keeps the distances in neighbourhoods spreads more, as the dual of "
            "the semidefinite program certifies. Variances are in squared units of the "
            "observation distances."
          : "The solution of the semidefinite program is not certified. Variances are in squared "
            "units "
            "of the observation distances."));
  section.blocks.emplace_back(KeyValues{
      {item("Solver", std::string(title_of_solver(certificate.solver))),
       item("Variance reached", fmt::format("{:.9g}", certificate.primal)),
       item("Upper bound", std::move(bound)),
       item("Relative gap", gap_text(certificate.relative_gap)),
       item("Largest violation of a constraint", residual_text(certificate.constraint_residual))}});
  return section;
}

}  // namespace mapproof
