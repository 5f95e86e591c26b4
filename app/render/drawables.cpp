#include "app/render/drawables.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/map/map_folder.hpp"
#include "app/slam/range_map.hpp"
#include "app/study/embedded_experiments.hpp"
#include "app/study/folder_report.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/studies/study_page.hpp"
#include "core/records/studies/study_store.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/maps/map_ellipses.hpp"
#include "render/figures/score_text.hpp"
#include "render/plot/figure_json.hpp"
#include "render/scene/scene_json.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// The figures of a folder have this name in reports and maps.
fs::path root_of(const fs::path& folder) {
  const fs::path whole = folder.filename().empty() ? folder.parent_path() : folder;
  const std::string name = whole.filename().string();
  if (!name.starts_with("figures")) return folder;
  return whole.has_parent_path() ? whole.parent_path() : fs::path(".");
}

/// Files of values, in the order of their names, but that of a map first.
std::vector<fs::path> value_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.ends_with(".figure.json") || name.ends_with(".scene.json"))
      files.push_back(entry->path());
  }
  if (error && is_folder(folder))
    throw IoError(folder.string(), "cannot be listed: " + error.message());
  std::ranges::sort(files);
  std::ranges::stable_partition(
      files, [](const fs::path& file) { return file.filename() == "map.figure.json"; });
  return files;
}

void add_file(const fs::path& file, Drawables& drawables) {
  const std::string text = read_file(file);
  const std::string name = file.filename().string();
  if (name.ends_with(".scene.json"))
    drawables.scenes.push_back(scene_from_json(text, file.string()));
  else
    drawables.figures.push_back(figure_from_json(text, file.string()));
}

/// The figure of a map from its record, where no figure was written.
Figure figure_of_map(const fs::path& file) {
  const std::string text = read_file(file);
  const MapRecord record = parse_map(text, file.string());
  Figure figure = map_figure(record, "map");
  figure.title = title_with_error(figure.title, record);
  if (const auto uncertainty = parse_map_uncertainty(text, file.string()))
    add_ellipses(record, *uncertainty, figure);
  return figure;
}

Drawables from_folder(const fs::path& folder) {
  refuse_links_out(folder);
  if (is_study(folder) || !study_folders(folder).empty()) {
    FolderReport report = read_folder_report(folder, std::nullopt, "");
    return {.root = folder,
            .figures = std::move(report.figures),
            .scenes = std::move(report.scenes),
            .films = std::move(report.films)};
  }
  Drawables drawables{.root = root_of(folder), .figures = {}, .scenes = {}, .films = {}};
  std::vector<fs::path> files = value_files(folder);
  if (files.empty()) files = value_files(folder / "figures");
  for (const fs::path& file : files) add_file(file, drawables);
  if (files.empty() && is_there(folder / kMapFile))
    drawables.figures.push_back(figure_of_map(folder / kMapFile));
  if (ids_of(drawables).empty())
    throw IoError(folder.string(),
                  "holds nothing to draw: no study, no map and no ID.figure.json or ID.scene.json");
  return drawables;
}

/// The figures that a page carries. They are drawn next to it.
Drawables from_page(const fs::path& file) {
  const StudyPage page(file);
  Drawables drawables{.root = file.has_parent_path() ? file.parent_path() : fs::path("."),
                      .figures = {},
                      .scenes = {},
                      .films = {}};
  page.with_names([&] {
    for (const fs::path& figure : value_files(page.folder() / "figures"))
      add_file(figure, drawables);
  });
  if (ids_of(drawables).empty()) throw IoError(file.string(), "carries no figures");
  return drawables;
}

}  // namespace

Drawables read_drawables(const fs::path& input) {
  if (is_folder(input)) return from_folder(input);
  if (is_page(input)) return from_page(input);
  const std::string name = input.filename().string();
  const fs::path folder = input.has_parent_path() ? input.parent_path() : fs::path(".");
  Drawables drawables{.root = root_of(folder), .figures = {}, .scenes = {}, .films = {}};
  std::error_code error;
  if (!fs::exists(input, error)) throw IoError(input.string(), "there is no such file or folder");
  if (name == kMapFile)
    drawables.figures.push_back(figure_of_map(input));
  else if (name == kSlamFile || name == "study.json")
    return from_folder(folder);
  else if (name.ends_with(".json"))
    add_file(input, drawables);
  else
    throw IoError(input.string(),
                  "is not a figure: a figure is a folder of mapproof, the page of a report, "
                  "ID.figure.json or "
                  "ID.scene.json");
  return drawables;
}

std::vector<std::string> ids_of(const Drawables& drawables) {
  std::vector<std::string> ids;
  for (const Figure& figure : drawables.figures) ids.push_back(figure.id);
  for (const Scene& scene : drawables.scenes) ids.push_back(scene.id);
  return ids;
}

Figure panel_figure(const std::string& panel, const std::optional<Drawables>& from) {
  if (from) {
    const auto found = std::ranges::find(from->figures, panel, &Figure::id);
    if (found != from->figures.end()) return *found;
  }
  std::error_code error;
  if (!fs::exists(panel, error)) {
    const std::string known =
        from ? fmt::format("; there are the figures {}", fmt::join(ids_of(*from), ", ")) : "";
    throw InvalidInput(
        fmt::format("--panel: {} is neither a folder nor a file{}", printable(panel), known));
  }
  Drawables drawables = read_drawables(panel);
  if (drawables.figures.empty())
    throw InvalidInput(
        fmt::format("--panel: {} is a 3-D figure, which has no axes to share", printable(panel)));
  return std::move(drawables.figures.front());
}

}  // namespace mapproof
