#pragma once

#include <string>

#include <kainjow/mustache.hpp>

#include "reports/html/templates.hpp"

namespace mapproof {

/// Sets what every page's head asks for: "policy", "style_element" and "script_element", of what
/// pages have in common (common.css, common.js and its parts common_*.js) and of the page's own:
/// NAME.css, NAME.js and, before them, their parts (NAME_*.js). The policy lets in that style
/// sheet, that script, images within the page, and nothing else.
void set_page_frame(kainjow::mustache::data& page, const std::string& name,
                    const Templates& templates);

/// NAME.mustache with what it includes, filled with `page`; every text is escaped.
/// @throws IoError if a template fails.
std::string rendered(const std::string& name, const Templates& templates,
                     const kainjow::mustache::data& page);

}  // namespace mapproof
