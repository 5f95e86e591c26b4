#include "app/map/outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "app/build_facts.hpp"
#include "app/map/joint_map_report.hpp"
#include "app/map/map_folder.hpp"
#include "app/map/title.hpp"
#include "core/base/files.hpp"
#include "core/base/input_file.hpp"
#include "core/records/maps/map_files.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/maps/map_ellipses.hpp"
#include "render/figures/maps/submaps.hpp"
#include "render/output/write_figure.hpp"
#include "reports/sections/certainty_section.hpp"
#include "reports/sections/map_report.hpp"
#include "reports/sections/study_figures.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

std::vector<std::pair<std::string, std::string>> facts(const MapArguments& arguments,
                                                       const MapResult& map) {
  const MapRecord& record = map.record;
  std::vector<std::pair<std::string, std::string>> items = {
      {"Observations", input_name(arguments.input.path)}, {"Sensor", sensor_label(map.record)}};
  items.insert(items.end(), map.read.begin(), map.read.end());
  items.emplace_back("Method", method_label(map.record));
  if (record.anchors.empty()) {
    items.emplace_back("Anchors", "none");
  } else {
    std::string names;
    for (const Eigen::Index row : record.anchors)
      names += (names.empty() ? "" : ", ") + record.names[static_cast<std::size_t>(row)];
    items.emplace_back(
        "Anchors",
        names + (arguments.anchors.empty() ? " (the furthest out along the diagonals)" : ""));
    items.emplace_back(arguments.input.rigid ? "Fit to the anchors" : "Affine fit to the anchors",
                       arguments.fit);
  }
  return items;
}

/// The map first, as drawn with what is known of it, then the others.
std::vector<Figure> figures_of(const MapResult& map) {
  std::vector<Figure> figures = {map_figure(map.record, "map")};
  if (map.certainty) add_ellipses(map.record, *map.certainty, figures.front());
  if (map.joined) figures.push_back(submaps_figure(*map.joined, map.record.names, "submaps"));
  if (map.mixed)
    if (std::optional<Figure> figure = mixed_figure(*map.mixed))
      figures.push_back(std::move(*figure));
  return figures;
}

Report report_of(const MapArguments& arguments, const MapResult& map,
                 const std::vector<Figure>& figures, const std::string& command) {
  std::vector<Section> sections;
  if (map.mixed) sections.push_back(mixed_section(*map.mixed));
  if (map.choice) sections.push_back(choice_section(*map.choice));
  if (map.certainty) sections.push_back(certainty_section(map.record, *map.certainty));
  std::vector<FigureBlock> more;
  for (std::size_t k = 1; k < figures.size(); ++k) more.push_back(figure_block(figures[k]));
  return map_report({.record = map.record,
                     .title = map_title(arguments.input.path),
                     .facts = facts(arguments, map),
                     .remarks = map.remarks,
                     .warnings = map.warnings,
                     .figure = figure_block(figures.front()),
                     .more_figures = std::move(more),
                     .provenance = build_provenance(),
                     .command = command,
                     .more = std::move(sections)});
}

/// Removes what an earlier map in this folder had and this one has not.
void remove_stale(const fs::path& out, const std::vector<Figure>& figures, const MapResult& map) {
  for (const char* id : {"submaps", "sensors"})
    if (std::ranges::find(figures, id, &Figure::id) == figures.end())
      for (const char* ending : {".svg", ".png", ".pdf", ".figure.json"})
        fs::remove(out / "figures" / (std::string(id) + ending));
  if (!map.estimated) fs::remove(out / "labels.csv");
}

}  // namespace

void write_outputs(const MapArguments& arguments, const MapResult& map, const Templates& page,
                   const std::string& command) {
  const std::vector<Figure> figures = figures_of(map);
  const Report report = report_of(arguments, map, figures, command);
  const MapFolder folder(arguments.out, map.record);
  const fs::path& out = folder.path();
  // The file that marks the folder as a map's comes first: a killed command can then be repeated.
  write_file(out / kMapFile,
             map_json(map.record, map.certainty,
                      map.mixed ? std::optional(map.mixed->sensors) : std::nullopt));
  write_file(out / "map.csv", map_csv(map.record, map.certainty));
  remove_stale(out, figures, map);
  if (map.estimated) write_file(out / "labels.csv", labels_csv(*map.estimated));
  std::map<std::string, std::string> drawn;
  for (const Figure& figure : figures)
    drawn[figure.id] = write_figure(figure, report_theme(), out / "figures");
  write_tables(report, out / "tables");
  const std::string html = report_html(report, page, [&](const std::string& id) {
    const auto found = drawn.find(id);
    return found == drawn.end() ? std::string() : found->second;
  });
  write_file(out / "report.html", html);
}

}  // namespace mapproof
