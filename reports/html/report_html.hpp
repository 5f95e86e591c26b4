#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "reports/html/html_options.hpp"
#include "reports/html/templates.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// One self-contained page: it fetches nothing, which its content security policy also forbids.
/// @throws IoError if a template fails; InvalidInput if the report breaks its rules (see check), or
///         a drawing could end the element that holds it.
std::string report_html(const Report& report, const Templates& templates, const SvgLookup& svg,
                        const HtmlOptions& options = {});

}  // namespace mapproof
