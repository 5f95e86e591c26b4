#pragma once

#include <span>
#include <string>

#include "core/model/study.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// The starts of the program on a study, a row each.
Table sessions_table(std::string id, std::span<const Session> sessions);

}  // namespace mapproof
