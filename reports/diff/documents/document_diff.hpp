#pragma once

#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/item_files.hpp"

namespace mapproof {

/// Compares a table in its formats or a report's page: what follows from records and figures.
/// @param told  What was said of records, figures and, for a page, tables: a page is compared
///              without what has an item of its own that is not identical.
/// @param baseline, current  Null: that side does not have the item.
DiffItem document_item(const std::string& id, const ItemFiles* baseline, const ItemFiles* current,
                       const std::vector<DiffItem>& told, const DiffSettings& settings);

/// All tables, then all pages of two lists. Appended to `items`, which hold all else.
/// @param sole  What a single file is called.
void add_documents(std::vector<DiffItem>& items, const ItemList& baseline, const ItemList& current,
                   const std::string& sole, const DiffSettings& settings);

}  // namespace mapproof
