#pragma once

#include <optional>

#include "core/model/slam.hpp"
#include "core/model/study.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// How near their optima the semidefinite programs of a study came: a row for each sensor, setting
/// and solver, with the worst of its records. Empty if the study has none.
std::optional<Section> proofs_section(const Study& study);

/// What proves one map, or what is missing.
Section certificate_section(const Certificate& certificate);

}  // namespace mapproof
