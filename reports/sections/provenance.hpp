#pragma once

#include <span>
#include <string>

#include "core/model/study.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Who made the study, how, and from what: a pure function of the records.
Section provenance_section(const Study& study, std::span<const Session> sessions,
                           std::span<const Timing> timings, const std::string& command);

/// The starts of the program on a study, a row each.
Table sessions_table(std::string id, std::span<const Session> sessions);

}  // namespace mapproof
