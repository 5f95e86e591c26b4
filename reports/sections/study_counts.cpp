#include "reports/sections/study_counts.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"

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

long warned_percent(const StudyCounts& counts) {
  if (counts.with_status == 0 || counts.with_status == counts.maps)
    return counts.with_status == 0 ? 0 : 100;
  return std::clamp((200 * counts.with_status + counts.maps) / (2 * counts.maps), 1L, 99L);
}

std::string endings_text(const StudyCounts& counts) {
  std::vector<std::string> parts;
  const auto add = [&](long some, const std::string& share, const char* ends, const char* end) {
    if (some > 0)
      parts.push_back(
          (parts.empty() ? part_text(some, counts.maps, "map") : count_text(some, counts.maps)) +
          share + " " + (some == 1 ? ends : end));
  };
  const bool is_little = 100 * counts.with_status < counts.maps;
  add(counts.with_status,
      is_little ? " (under 1\u00a0%)" : fmt::format(" ({}\u00a0%)", warned_percent(counts)),
      "has a warning", "have warnings");
  add(counts.unscored, "", "has no score", "have no score");
  add(counts.failed, "", "could not be made", "could not be made");
  return parts.empty() ? "no map has a warning" : listed(parts, parts.size());
}

}  // namespace mapproof
