#pragma once

#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/items.hpp"

namespace mapproof {

/// Compares a table in its formats, or a report's page. Both follow from records and figures.
/// @param reported  The items of records, figures and, for a page, tables. A page is compared
/// without the parts that have an item of their own that is not identical.
/// @param baseline, current  Null if that side does not have the item.
DiffItem document_item(const std::string& id, const ItemFiles* baseline, const ItemFiles* current,
                       const std::vector<DiffItem>& reported, const DiffSettings& settings);

/// Compares all tables, then all pages of two lists. Appends them to `items`, which holds all
/// others.
/// @param sole  The name of a single file.
void add_documents(std::vector<DiffItem>& items, const ItemList& baseline, const ItemList& current,
                   const std::string& sole, const DiffSettings& settings);

}  // namespace mapproof
