#include <algorithm>

#include <fmt/format.h>

#include "render/figures/status_words.hpp"
#include "reports/sections/slam/slam_report.hpp"
#include "reports/sections/slam/slam_words.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

void add_statuses(const std::string& where, const std::string& id,
                  const std::vector<Status>& statuses, StatusList& list) {
  for (const Status& status : statuses) {
    const auto same = [&](const StatusList::Item& item) {
      return item.code == name(status.code) && item.where == where;
    };
    auto item = std::ranges::find_if(list.items, same);
    if (item == list.items.end()) {
      list.items.push_back({std::string(name(status.code)),
                            std::string(meaning(status.code)),
                            where,
                            0,
                            1,
                            status.code == StatusCode::kFailed,
                            {}});
      item = list.items.end() - 1;
    }
    item->count = 1;
    item->places.push_back({id, status_words(status)});
  }
}

}  // namespace

Section slam_statuses_section(const SlamStudy& study) {
  Section section{"slam-statuses", "Range-only SLAM: warnings and failures", {}};
  StatusList list;
  for (const SlamRun& run : study.runs)
    for (const SlamRecord& record : run.records)
      add_statuses(fmt::format("{}, {}", title_of(run), info(record.method).label),
                   record_id(run, record), record.estimate.statuses, list);
  if (study.histories)
    for (const RangeHistoryMap& map : study.histories->maps)
      add_statuses(fmt::format("{}, {}", map.squared ? "squared ranges" : "ranges",
                               map.setting ? label(*map.setting) : "spectral"),
                   "histories", map.statuses, list);
  if (study.space)
    for (const SpaceRecord& record : study.space->records)
      add_statuses(fmt::format("in space, {}",
                               record.knows_landmarks ? "landmarks known" : "no landmark known"),
                   "space", record.estimate.statuses, list);
  std::ranges::stable_partition(list.items, &StatusList::Item::failed);
  if (list.items.empty())
    section.blocks.emplace_back(plain("Nothing: each solve ended well."));
  else
    section.blocks.emplace_back(std::move(list));
  return section;
}

}  // namespace mapproof
