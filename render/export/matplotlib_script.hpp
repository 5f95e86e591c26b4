#pragma once

#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// "\"#0072b2\"".
std::string script_colour(Colour of);

/// Interpreter, description, imports and sizes.
std::string script_head(const std::string& id, const std::string& title, const Theme& theme);

/// The function legend(ax): a legend where something has a label.
std::string script_legend();

/// Title, notes, and the file that is written.
std::string script_tail(const std::string& id, const std::string& title,
                        const std::vector<Note>& notes);

}  // namespace mapproof
