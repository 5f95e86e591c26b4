#pragma once

#include <span>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/item_files.hpp"

namespace mapproof {

/// What the records around a figure say, to tie it to.
struct RecordContext {
  std::vector<const RecordDiff*> records;
};

/// Compares one figure or picture: its value, then its pictures, then why.
/// @param baseline, current  Null: that side does not have the item.
DiffItem item_diff(const std::string& id, const ItemFiles* baseline, const ItemFiles* current,
                   const RecordContext& context, const DiffSettings& settings);

/// Why the data of a figure changed, by the records that it names; and which way.
/// @param own  The figure's own judgement.
Judgement tied_judgement(const std::string& id, const FigureDiff& diff, const Judgement& own,
                         const std::vector<std::string>& record_ids, const RecordContext& context);

/// What the pictures of a figure add to the judgement of its value, or say alone.
/// @param has_value  Whether the figure's value was compared.
Judgement judge_pictures(const Judgement& value, bool has_value,
                         const std::vector<PictureFile>& pictures, const RecordContext& context);

}  // namespace mapproof
