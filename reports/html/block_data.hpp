#pragma once

#include <kainjow/mustache.hpp>

#include "reports/html/report_html.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// What the templates are told of a block. Every key that a template may ask for is set, since
/// Mustache would look for a missing one further out.
kainjow::mustache::data block_data(const Block& block, const SvgLookup& svg,
                                   const HtmlOptions& options);

}  // namespace mapproof
