#include "app/map/incremental_outputs.hpp"

#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "app/build_facts.hpp"
#include "app/map/map_folder.hpp"
#include "app/map/map_json.hpp"
#include "app/map/title.hpp"
#include "core/base/files.hpp"
#include "core/base/input_file.hpp"
#include "core/records/maps/map_files.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/status_words.hpp"
#include "render/output/write_figure.hpp"
#include "reports/html/report_html.hpp"
#include "reports/sections/map_report.hpp"
#include "reports/sections/study_figures.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

void write_report(const FollowedPlace& place, const MapResult& map, const Figure& figure,
                  const std::string& svg) {
  const Report report =
      map_report({.record = map.record,
                  .title = map_title(place.observations),
                  .facts = {{"Observations", input_name(place.observations)},
                            {"Sensor", sensor_label(map.record)},
                            {"Landmarks", std::to_string(map.record.names.size())},
                            {"Steps followed", std::to_string(map.record.step)},
                            {"Method", method_label(map.record)}},
                  .remarks = map.remarks,
                  .figure = figure_block(figure),
                  .more_figures = {},
                  .provenance = build_provenance(),
                  .command = place.command});
  write_tables(report, fs::path(place.out) / "tables");
  write_file(fs::path(place.out) / "report.html",
             report_html(report, place.page, [&](const std::string& id) {
               return id == figure.id ? svg : std::string();
             }));
}

}  // namespace

WriteFollowed followed_outputs(FollowedPlace place) {
  check_map_folder(place.out);
  make_folder(place.out);
  const auto lock = std::make_shared<FolderLock>(place.out);
  remove_leftovers(place.out);
  return [place = std::move(place), lock](const MapResult& map, bool last) {
    const fs::path out = place.out;
    write_file(out / kMapFile, map_json(map.record));
    write_file(out / "map.csv", map_csv(map.record));
    const Figure figure = map_figure(map.record, "map");
    const std::string svg = write_figure(figure, report_theme(), out / "figures");
    if (last) write_report(place, map, figure, svg);
  };
}

int report_followed(const MapResult& map, const std::string& out, const Invocation& invocation) {
  for (const std::string& remark : map.remarks) invocation.console.warning(remark);
  for (const Status& status : map.record.statuses)
    invocation.console.warning(fmt::format("{}: {}", name(status.code), status_words(status)));
  invocation.console.result(map_text(map, out), map_json(map, out));
  return map.record.estimate.array().isNaN().all() ? kNo : kDone;
}

}  // namespace mapproof
