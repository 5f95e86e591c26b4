#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "render/base/geometry.hpp"
#include "reports/diff/records/record_comparison.hpp"
#include "reports/diff/records/record_set.hpp"
#include "reports/diff/verdict/tolerances.hpp"
#include "reports/diff/verdict/verdict.hpp"

namespace mapproof {

/// Compares records run by run. With three or more units of equal seeds, the test of
/// core/statistics/paired_runs.hpp, corrected by Holm over all quantities that differ beyond
/// tolerance, and its effect size decide between better, worse and changed. With fewer units, all
/// errors that differ, of any quantity and subject, must change in one direction; quantities of the
/// solver decide nothing then. Only
/// quantities with a difference are tested. Under the null hypothesis, by which both signs are
/// equally likely, leaving out the others changes no probability.
/// @throws InvalidInput if they are records of two kinds.
RecordDiff record_diff(const RecordSet& baseline, const RecordSet& current,
                       const RecordOptions& options = {});

/// The comparisons behind a record id of a figure: of one record, or of a subject over all runs.
struct RecordTie {
  std::vector<const Comparison*> comparisons;  ///< Of its subject; empty: all equal.
  std::vector<const PointsDiff*> points;       ///< Of that one record.
  std::vector<const OtherDiff*> others;        ///< Its own files that differ beyond tolerance.
  std::string run;                             ///< Empty: over all runs.
};

/// @param id  Of Figure::record_ids: "layout-1-pose-2/bearing/lpca/2000", "bearing/lpca/2000 of 5
///            runs", "histories/range/isomap", "space".
RecordTie tie(const RecordDiff& diff, const std::string& id);

}  // namespace mapproof
