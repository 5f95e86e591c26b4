#pragma once

#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/html/diff/shown_images.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {

/// One self-contained page on a comparison (docs/diff.md): verdicts and causes, images of the
/// differing items, tables of movements, checkboxes for approval. It fetches nothing, which its
/// content security policy also forbids; it is readable without a script. Images are data of <img>,
/// never markup.
///
/// @param shown  Of shown_images(), for each item of the result.
/// @param page_bytes  As of its ImageBudget: tables that do not fit are left out.
/// @throws IoError if a template fails.
std::string diff_html(const DiffResult& result, const std::vector<ShownImages>& shown,
                      const Templates& templates, std::size_t page_bytes = kPageBytes);

}  // namespace mapproof
