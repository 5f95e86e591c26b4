#include "reports/sections/study_counts.hpp"

#include <algorithm>

namespace mapproof {
namespace {

bool is_failed(const RunRecord& record) {
  return std::ranges::find(record.statuses, StatusCode::kFailed, &Status::code) !=
         record.statuses.end();
}

}  // namespace

StudyCounts count(const Study& study) {
  StudyCounts counts;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records) {
      ++counts.maps;
      if (!record.statuses.empty()) ++counts.with_status;
      if (!record.score) ++counts.unscored;
      if (is_failed(record)) ++counts.failed;
    }
  return counts;
}

}  // namespace mapproof
