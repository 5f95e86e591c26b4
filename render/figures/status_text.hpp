#pragma once

#include <string>
#include <vector>

#include "core/model/status.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// The meaning of the status, in a sentence or two.
std::string status_text(const Status& status);

/// Adds a warning a line, four at most, and how many more there are.
void add_status_notes(const std::vector<std::string>& lines, std::vector<Note>& notes);

}  // namespace mapproof
