#pragma once

#include <string>
#include <string_view>

#include "reports/model/report.hpp"

namespace mapproof::test {

/// @throws std::runtime_error if the section has no such table.
const Table& table_named(const Section& section, std::string_view id);

/// Every word of a section, for what is said rather than where.
std::string words(const Section& section);

bool contains_text(const Section& section, const std::string& what);

}  // namespace mapproof::test
