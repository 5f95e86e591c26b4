#pragma once

#include <string>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/html/diff/shown_pictures.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {

/// One self-contained page on a comparison (docs/diff.md): verdicts and causes, pictures of what
/// differs, tables of what moved, ticks for approval. Nothing is fetched, and its content security
/// policy forbids it; without a script it can be read. Pictures are data of <img>, never markup.
///
/// Reads the pictures again: they have to be those that were compared.
/// @throws IoError if a template fails. Pictures that cannot be read are left out, and it is said.
std::string diff_html(const DiffResult& result, const DiffSettings& settings,
                      const Templates& templates, const PictureBudget& budget = {});

}  // namespace mapproof
