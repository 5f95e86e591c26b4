#pragma once

#include <string>
#include <vector>

#include "reports/diff/figures/figure_diff.hpp"
#include "reports/diff/records/record_diff.hpp"
#include "reports/diff/verdict/verdict.hpp"

namespace mapproof {

/// The comparisons of the records that belong to a figure or an image.
struct RecordContext {
  std::vector<const RecordDiff*> records;
};

/// States why the data of a figure changed, by the records that it names, and whether they became
/// better or worse.
/// @param own  The judgement of the figure alone.
Judgement tied_judgement(const std::string& id, const FigureDiff& diff, const Judgement& own,
                         const std::vector<std::string>& record_ids, const RecordContext& context);

/// Whether records that a figure shows differ beyond tolerance in what it shows: positions, or the
/// quantity of its id. If the figure is equal then, it was not drawn again.
bool is_stale(const std::string& id, const std::vector<std::string>& record_ids,
              const RecordContext& context);

}  // namespace mapproof
