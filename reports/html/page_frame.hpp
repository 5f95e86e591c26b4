#pragma once

#include <string>

#include <kainjow/mustache.hpp>

#include "reports/html/templates.hpp"

namespace mapproof {

/// Sets the data for the head of every page: "policy", "style_element" and "script_element", from
/// the common files (common.css, common.js and its parts common_*.js) and those of the page:
/// NAME.css, NAME.js and, before them, their parts (NAME_*.js). The policy allows that style sheet,
/// that script, images within the page, and nothing else.
void set_page_frame(kainjow::mustache::data& page, const std::string& name,
                    const Templates& templates);

/// NAME.mustache with its partials, filled with `page`; every text is escaped.
/// @throws IoError if a template fails.
std::string rendered(const std::string& name, const Templates& templates,
                     const kainjow::mustache::data& page);

}  // namespace mapproof
