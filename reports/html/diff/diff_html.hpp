#pragma once

#include <string>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/html/diff/shown_images.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {

/// One self-contained page on a comparison (docs/diff.md): verdicts and causes, images of the
/// differing items, tables of movements, checkboxes for approval. It fetches nothing, which its
/// content security policy also forbids; it is readable without a script. Images are data of <img>,
/// never markup.
///
/// Reads the images again: they must be those that were compared.
/// @throws IoError if a template fails. Images that cannot be read are left out; the page states
/// so.
std::string diff_html(const DiffResult& result, const DiffSettings& settings,
                      const Templates& templates, const ImageBudget& budget = {});

}  // namespace mapproof
