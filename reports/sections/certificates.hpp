#pragma once

#include <optional>

#include "core/model/certificate.hpp"
#include "core/model/study.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// How near their optima the semidefinite programs of a study came: a row for each sensor, setting
/// and solver, with the worst of its records. Empty if the study has none.
std::optional<Section> certificates_section(const Study& study);

/// The certificate of one map, or what it lacks.
Section certificate_section(const Certificate& certificate);

}  // namespace mapproof
