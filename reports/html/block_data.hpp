#pragma once

#include <kainjow/mustache.hpp>

#include "reports/html/figure_data.hpp"
#include "reports/html/report_html.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// What the templates are told of a block. Every key that a template may ask for is set, since
/// Mustache would look for a missing one further out.
kainjow::mustache::data block_data(const Block& block, const FigureContext& drawn,
                                   const HtmlOptions& options);

/// The phrases of a paragraph, for the template of that name.
kainjow::mustache::data phrases_data(const Paragraph& paragraph, const HtmlOptions& options);

}  // namespace mapproof
