#include "app/map/outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/build_facts.hpp"
#include "app/failures.hpp"
#include "app/map/pipeline.hpp"
#include "app/result_json.hpp"
#include "app/study/folder_report.hpp"
#include "app/study/page_content.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/records/maps/map_json.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/maps/map_ellipses.hpp"
#include "render/figures/score_text.hpp"
#include "render/figures/status_text.hpp"
#include "render/scene/map_scene.hpp"
#include "render/scene_client/scene_client.hpp"
#include "reports/html/report_html.hpp"
#include "reports/html/report_pages.hpp"
#include "reports/sections/fit_section.hpp"
#include "reports/sections/fit_text.hpp"
#include "reports/sections/map_report.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/study_figures.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMapScene = "scene-map";  // docs/figures.md

/// "Map of seen.csv", for a report.
std::string map_title(const std::string& observations) {
  const bool has_position = !handed_in(observations);
  return "Map of " + (has_position ? std::filesystem::path(observations).filename().string()
                                   : input_name(observations));
}

/// The map first, as drawn with what is known of it, then the others.
std::vector<Figure> figures_of(const MapResult& map) {
  std::vector<Figure> figures = {map_figure(map.record, "map")};
  figures.front().title = title_with_error(figures.front().title, map.record);
  if (map.uncertainty) add_ellipses(map.record, *map.uncertainty, figures.front());
  if (!map.fit.tests.empty()) figures.push_back(fit_figure(map.fit, kFitSection, {map.record.id}));
  figures.insert(figures.end(), map.figures.begin(), map.figures.end());
  return figures;
}

/// The map in space, as far as it can be drawn; none where the program was built without the one
/// that draws scenes.
std::vector<Scene> scenes_of(const MapResult& map, const Figure& figure) {
  std::error_code error;
  if (!fs::exists(scenes_program(), error) || !has_map_scene(map.record)) return {};
  const std::size_t finding = figure.title.rfind(": ");
  MapSceneSpec spec{.id = kMapScene,
                    .title = finding == std::string::npos
                                 ? "The map in space"
                                 : "In space" + figure.title.substr(finding),
                    .map = map.record};
  for (Eigen::Index i = 0; map.uncertainty && i < map.record.estimate.rows(); ++i) {
    const std::optional<Ellipse> ellipse = confidence_ellipse(*map.uncertainty, i);
    spec.half_axes.push_back(ellipse ? ellipse->a : kNaN);
  }
  return {map_scene(spec)};
}

Report report_of(const MapOutput& location, const MapResult& map,
                 const std::vector<Figure>& figures, const std::vector<Scene>& scenes) {
  std::vector<FigureBlock> of_fit;
  std::vector<FigureBlock> more;
  for (std::size_t k = 1; k < figures.size(); ++k)
    (figures[k].id == kFitSection ? of_fit : more).push_back(figure_block(figures[k]));
  for (const Scene& scene : scenes) more.insert(more.begin(), figure_block(scene));
  const std::string verdict = with_anchors(verdict_text(map.fit), map.record);
  std::vector<std::pair<std::string, std::string>> facts = map.facts;
  facts.insert(
      facts.begin(),
      {"Observations", location.disclosure.words({input_name(location.observations)}).front()});
  return map_report({.record = map.record,
                     .title = map_title(location.observations),
                     .facts = std::move(facts),
                     .remarks = map.remarks,
                     .warnings = map.warnings,
                     .figure = figure_block(figures.front()),
                     .more_figures = std::move(more),
                     .provenance = build_provenance(),
                     .command = location.command,
                     .more = map.sections,
                     .fit = fit_section(map.fit, of_fit, kFitSection, kFitTitle, verdict),
                     .verdict = verdict,
                     .fit_number = fit_number(map.fit)});
}

/// Removes what a step gave to an earlier map in this folder and not to this one.
void remove_stale(const OutputFolder& out, const MapResult& map, const std::vector<Scene>& scenes) {
  if (scenes.empty())
    for (const char* ending : {".svg", ".png", ".pdf", ".scene.json"})
      (out / "figures").remove(std::string(kMapScene) + ending);
  for (const MapStep* step : map_steps()) {
    const bool is_drawn =
        step->figure == kFitSection
            ? !map.fit.tests.empty()
            : std::ranges::find(map.figures, step->figure, &Figure::id) != map.figures.end();
    if (!step->figure.empty() && !is_drawn)
      for (const char* ending : {".svg", ".png", ".pdf", ".figure.json"})
        (out / "figures").remove(std::string(step->figure) + ending);
    if (!step->file.empty() &&
        std::ranges::find(map.files, step->file, &NamedPart<std::string>::name) == map.files.end())
      out.remove(step->file);
  }
}

nlohmann::ordered_json landmark_json(const MapResult& map, Eigen::Index i) {
  const MapRecord& record = map.record;
  const std::string unit = record.frame == Frame::kGroundTruth ? "_m" : "";
  nlohmann::ordered_json landmark{{"name", record.names[static_cast<std::size_t>(i)]},
                                  {"x" + unit, number_or_null(record.estimate(i, 0))},
                                  {"y" + unit, number_or_null(record.estimate(i, 1))}};
  if (!map.uncertainty) return landmark;
  landmark["ellipse"] = nullptr;
  if (const std::optional<Ellipse> ellipse = confidence_ellipse(*map.uncertainty, i))
    landmark["ellipse"] = {{"a" + unit, ellipse->a},
                           {"b" + unit, ellipse->b},
                           {"rotation_rad", ellipse->rotation_rad}};
  return landmark;
}

/// What a map came to, as one JSON object. @param out  The folder that it was written to.
nlohmann::ordered_json result_json(const MapResult& map, const fs::path& out) {
  const MapRecord& record = map.record;
  const MethodSetting* setting = setting_of(record);
  nlohmann::ordered_json object{
      {"sensor", sensor_name(record)},
      {"method", method_name(record)},
      {"parameter", setting != nullptr ? parameter_json(*setting) : nullptr},
      {"steps", record.step},
      {"frame", name(record.frame)},
      {"score", nullptr},
      {"landmarks", nlohmann::ordered_json::array()},
      {"fit", fit_json(map.fit)},
      {"statuses", statuses_json(record.statuses)},
      {"data_association", nlohmann::ordered_json::array()},
      {"remarks", map.remarks},
      {"warnings", map.warnings},
      {"map", (out / kMapFile).string()},
      {"report", (out / "report.html").string()}};
  if (record.score)
    object["score"] = {
        {"mpe_m", number_or_null(record.score->mpe_m)},
        {"moe_percent", number_or_null(record.score->moe_percent)},
        {"mpe_all_fitted_m", number_or_null(record.score->mpe_all_fitted_m)},
        {"moe_unmirrored_percent", number_or_null(record.score->moe_unmirrored_percent)}};
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i)
    object["landmarks"].push_back(landmark_json(map, i));
  for (const auto& [name, value] : map.members) object[name] = value;
  return object;
}

/// The same in two lines: method, step and errors, and the report.
std::string map_text(const MapResult& map, const fs::path& out) {
  const MapRecord& record = map.record;
  const bool is_chosen =
      std::ranges::any_of(map.members, [](const auto& member) { return member.name == "choice"; });
  std::string text = fmt::format("Method: {}{}, {}, {}", method_label(record),
                                 is_chosen ? " (chosen, see the report)" : "", sensor_label(record),
                                 counted(record.step, "step"));
  if (record.score)
    if (const std::string score = score_text(*record.score); !score.empty()) {
      const std::string scored = scored_landmarks_text(record);
      text += ": " + score + (scored.empty() ? "" : " (" + scored + ")");
    }
  text += "\n" + with_anchors(verdict_text(map.fit), record);
  return text + "\n" + (out / "report.html").string() + "\n";
}

/// A page with the record of more landmarks would be too large.
constexpr std::size_t kMostLandmarksOfPage = 5000;

/// What the page carries: the map, unless it is large, and its figures, all of which it shows.
PageData page_data(const fs::path& folder, const MapRecord& map, const Images& images,
                   const Disclosure& disclosure) {
  std::set<std::string> shown;
  for (const Figure* figure : images.figures) shown.insert(figure->id);
  for (const Scene* scene : images.scenes) shown.insert(scene->id);
  const bool is_large = map.names.size() > kMostLandmarksOfPage;
  return FigureData(images, disclosure)
      .content(is_large ? PageData{} : page_records(folder, disclosure), shown)
      .data;
}

}  // namespace

std::string write_map(const MapFolder& folder, const MapOutput& location, const MapResult& map,
                      bool last) {
  const OutputFolder out(folder.path());
  const std::vector<Figure> figures = figures_of(map);
  const std::vector<Scene> scenes = last ? scenes_of(map, figures.front()) : std::vector<Scene>();
  // The file that marks the folder as a map's comes first: a killed command can then be repeated.
  out.write(kMapFile, map_json(map.record, map.uncertainty, map.sensors, map.fit));
  out.write("map.csv", map_csv(map.record, map.uncertainty));
  remove_stale(out, map, scenes);
  for (const auto& [name, text] : map.files) out.write(name, text);
  Images images;
  for (const Figure& figure : figures) images.figures.push_back(&figure);
  for (const Scene& scene : scenes) images.scenes.push_back(&scene);
  SceneClient client;
  const Drawn drawn = write_images(images,
                                   {.folder = out / "figures",
                                    .theme = report_theme(),
                                    .dark = dark_theme(),
                                    .jobs = location.jobs},
                                   client);
  if (!last) return "";
  Report report = report_of(location, map, figures, scenes);
  report.date = today_utc();
  write_tables(report, out / "tables");
  const auto drawing = [&](const std::string& id) { return drawn.svg(id, out.path() / "figures"); };
  const auto bytes_of = [&](const std::string& id) { return drawn.svg_bytes(id); };
  const std::vector<Report> pages = pages_of(report, bytes_of);
  const auto page = [&](std::size_t number) {
    return location.disclosure.text(report_html(pages[number - 1], location.page, drawing,
                                                page_options(number, pages.size(), {})));
  };
  write_further_pages(out, pages.size(), page);
  out.write("report.html", with_page_data(page(1), page_data(out.path(), map.record, images,
                                                             location.disclosure)));
  return drawn.scene_error;
}

int report_map(const MapResult& map, const MapOutput& location, const Invocation& invocation) {
  for (const Status& status : map.record.statuses)
    invocation.console.warning(fmt::format("{}: {}", name(status.code), status_text(status)));
  invocation.console.result(map_text(map, location.out), result_json(map, location.out));
  if (!map.record.estimate.array().isNaN().all()) return kDone;
  return report_no_map(location.observations, map.record.statuses);
}

}  // namespace mapproof
