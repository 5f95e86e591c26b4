#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/statistics/signed_rank.hpp"
#include "render/base/geometry.hpp"
#include "reports/diff/records/record_comparison.hpp"
#include "reports/diff/records/record_set.hpp"
#include "reports/diff/verdict/tolerances.hpp"
#include "reports/diff/verdict/verdict.hpp"

namespace mapproof {

/// Compares records run by run. Where six or more pairs of equal seeds are there, Wilcoxon's signed
/// rank test, corrected by Holm over all quantities that differ beyond tolerance, and its effect
/// size decide between better, worse and changed; with fewer pairs all errors that differ, of
/// whatever quantity and subject, have to point one way, and what is of the solver tells none.
///
/// Tests are of what differs at all: under the hypothesis that is tested, signs as likely up as
/// down, leaving out the quantities without a difference changes no chance.
/// @throws InvalidInput if they are records of two kinds.
RecordDiff record_diff(const RecordSet& baseline, const RecordSet& current,
                       const RecordOptions& options = {});

/// What a figure's record id stands for: one record, or a subject over all runs.
struct RecordTie {
  std::vector<const Comparison*> comparisons;  ///< Of its subject; empty: all equal.
  std::vector<const PointsDiff*> points;       ///< Of that one record.
  std::vector<const OtherDiff*> others;        ///< Files of it alone, beyond tolerance.
  std::string run;                             ///< Empty: over all runs.
};

/// @param id  Of Figure::record_ids: "layout-1-pose-2/bearing/lpca/2000", "bearing/lpca/2000 of 5
///            runs", "histories/range/isomap", "space".
RecordTie tie(const RecordDiff& diff, const std::string& id);

}  // namespace mapproof
