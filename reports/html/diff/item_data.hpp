#pragma once

#include <string>

#include <kainjow/mustache.hpp>

#include "reports/diff/approvals/approvals.hpp"
#include "reports/diff/diff_result.hpp"
#include "reports/html/diff/shown_pictures.hpp"

namespace mapproof {

/// The id of an item's element, by which links reach it: "figure-fig-7", "records-records".
std::string anchor_of(const DiffItem& item);

/// What diff_item.mustache is told of an item.
/// @param refusal  Why it cannot be approved by itself; null: it can.
/// @param number   Distinguishes ids on the page.
kainjow::mustache::data item_data(const DiffItem& item, const DiffResult& all,
                                  const ShownPictures& shown, const ApprovalRefusal* refusal,
                                  std::size_t number);

/// What lists say of an item: its name, verdict and anchor.
kainjow::mustache::data entry_data(const DiffItem& item);

}  // namespace mapproof
