#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "render/figures/status_words.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/study_counts.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kPlacesShown = 5;

/// Sensor, method, parameter: what statuses are counted by.
using StatusKind = std::tuple<Sensor, Method, double>;

StatusKind kind_of(const RunRecord& record) {
  return {record.sensor, record.setting.method, record.setting.parameter.value_or(0.0)};
}

void add_record(StatusList::Item& item, const RunId& run, const RunRecord& record,
                StatusCode code) {
  ++item.count;
  if (item.places.size() >= kPlacesShown) return;
  for (const Status& status : record.statuses)
    if (status.code == code)
      item.places.push_back(
          {record_id(run, record.sensor, record.setting, record.step), status_words(status)});
}

/// Severest first: no map, then by share.
bool before(const StatusList::Item& a, const StatusList::Item& b) {
  if (a.failed != b.failed) return a.failed;
  return static_cast<double>(a.count) * b.of > static_cast<double>(b.count) * a.of;
}

StatusList status_list(const Study& study) {
  std::map<StatusKind, int> totals;
  std::map<std::pair<StatusKind, StatusCode>, StatusList::Item> items;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records) {
      ++totals[kind_of(record)];
      for (std::size_t i = 0; i < record.statuses.size(); ++i) {
        const StatusCode code = record.statuses[i].code;
        const auto earlier = std::span(record.statuses).first(i);
        if (std::ranges::any_of(earlier, [&](const Status& s) { return s.code == code; })) continue;
        StatusList::Item& item = items[{kind_of(record), code}];
        item.where = fmt::format("{}, {}", name(record.sensor), label(record.setting));
        add_record(item, run.id, record, code);
      }
    }
  StatusList list;
  for (auto& [key, item] : items) {
    item.code = name(key.second);
    item.meaning = meaning(key.second);
    item.failed = key.second == StatusCode::kFailed || key.second == StatusCode::kAnchorsMissing;
    item.of = totals[key.first];
    list.items.push_back(std::move(item));
  }
  std::ranges::stable_sort(list.items, before);
  return list;
}

}  // namespace

Section statuses_section(const Study& study) {
  const StudyCounts counts = count(study);
  Section section;
  section.id = "statuses";
  section.title = "Warnings and failures";
  StatusList list = status_list(study);
  if (list.items.empty() && counts.unscored == 0) {
    section.blocks.emplace_back(
        plain(counts.maps == 0 ? "No map was made."
                               : fmt::format("Nothing: each solve ended well, {} in all.",
                                             counted(counts.maps, "map"))));
    return section;
  }
  section.blocks.emplace_back(plain(fmt::format(
      "Of {}, {} with a status, {} without a score, and {} of these no map at all. A status is "
      "data: the numbers above include every map that could be scored, with or without one.",
      counted(counts.maps, "map"), counts.with_status, counts.unscored, counts.failed)));
  section.blocks.emplace_back(std::move(list));
  return section;
}

}  // namespace mapproof
