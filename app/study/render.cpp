#include "app/commands.hpp"

#include <algorithm>
#include <iterator>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/study/folder_report.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "render/output/write_scene.hpp"

namespace mapproof {
namespace {

struct RenderArguments {
  std::string study;
  std::string out;
  std::string theme = "report";
  double width_in = 3.25;
  std::vector<std::string> ids;
  std::vector<std::string> animations;
  int jobs = 1;
};

std::vector<std::string> ids_of(const Images& images) {
  std::vector<std::string> ids;
  for (const Figure* figure : images.figures) ids.push_back(figure->id);
  for (const Scene* scene : images.scenes) ids.push_back(scene->id);
  return ids;
}

/// Each once, as it came first.
std::vector<std::string> without_repeats(const std::vector<std::string>& ids) {
  std::vector<std::string> once;
  for (const std::string& id : ids)
    if (std::ranges::find(once, id) == once.end()) once.push_back(id);
  return once;
}

/// Those of the ids that were asked for, all if none was.
Images chosen_images(const RenderArguments& arguments, const FolderReport& view) {
  Images all = images_of(view);
  if (arguments.ids.empty()) return all;
  Images chosen;
  for (const std::string& id : without_repeats(arguments.ids)) {
    const auto is_it = [&id](const auto* image) { return image->id == id; };
    const std::size_t before = chosen.figures.size() + chosen.scenes.size();
    std::ranges::copy_if(all.figures, std::back_inserter(chosen.figures), is_it);
    std::ranges::copy_if(all.scenes, std::back_inserter(chosen.scenes), is_it);
    if (chosen.figures.size() + chosen.scenes.size() > before) continue;
    throw InvalidInput(fmt::format("--figure: no figure \"{}\" in {}; there are {}", printable(id),
                                   arguments.study, fmt::join(ids_of(all), ", ")));
  }
  return chosen;
}

/// The films that were asked for. @throws InvalidInput for an id that none has.
std::vector<const Film*> chosen_films(const RenderArguments& arguments, const FolderReport& view) {
  std::vector<const Film*> chosen;
  std::vector<std::string> ids;
  for (const Film& film : view.films) ids.push_back(film.id);
  for (const std::string& id : without_repeats(arguments.animations)) {
    const auto found = std::ranges::find(view.films, id, &Film::id);
    if (found == view.films.end())
      throw InvalidInput(fmt::format(
          "--animate: nothing moves in \"{}\" of {}; {}", printable(id), arguments.study,
          ids.empty() ? "no scene does" : fmt::format("there are {}", fmt::join(ids, ", "))));
    chosen.push_back(&*found);
  }
  return chosen;
}

int render(const RenderArguments& arguments, const Invocation& invocation) {
  const FolderReport view = read_folder_report(arguments.study, std::nullopt, "");
  const std::vector<const Film*> films = chosen_films(arguments, view);
  // Animations alone, if nothing else was named.
  const bool only_films = !films.empty() && arguments.ids.empty();
  const Images images = only_films ? Images{} : chosen_images(arguments, view);
  const bool paper = arguments.theme == "paper";
  const std::filesystem::path folder = arguments.out.empty()
                                           ? view.folder / (paper ? "figures-paper" : "figures")
                                           : std::filesystem::path(arguments.out);
  const Theme theme = paper ? paper_theme(arguments.width_in) : report_theme();
  make_folder(folder);
  const FolderLock lock(folder);
  remove_leftovers(folder);
  SceneClient client;  // One program draws scenes and films.
  const Drawn drawn = write_images(images, theme, folder, arguments.jobs, client);
  if (!drawn.scene_error.empty()) throw SceneError(drawn.scene_error);
  for (const Film* film : films) write_animation(*film, theme, folder, client);

  nlohmann::ordered_json object{{"study", arguments.study},
                                {"folder", folder.string()},
                                {"figures", nlohmann::ordered_json::array()}};
  std::string text;
  for (const std::string& id : ids_of(images)) {
    object["figures"].push_back(id);
    text += (folder / (id + ".svg")).string() + "\n";
  }
  for (const Film* film : films) {
    object["animations"].push_back(film->id);
    text += (folder / (film->id + ".apng")).string() + "\n";
  }
  invocation.console.result(text, object);
  return kDone;
}

}  // namespace

Action render_command(CLI::App& app) {
  auto arguments = std::make_shared<RenderArguments>();
  app.description(
      "Draw a study's figures and scenes again from its records (SVG, PNG, PDF), or animate a "
      "scene");
  app.footer(
      "Examples:\n"
      "  mapproof render out\n"
      "  mapproof render out --theme paper --width 6.75 --figure map-bearing-isomap\n"
      "  mapproof render out --animate scene-forming-bearing\n");
  app.add_option("DIR", arguments->study, "The study's folder")->required()->check(names_folder());
  add_out_option(app, arguments->out,
                 "Folder for the figures (default: DIR/figures, DIR/figures-paper)");
  app.add_option("--theme", arguments->theme, "report (screen) or paper (8 pt, 300 dpi)")
      ->check(CLI::IsMember({"report", "paper"}))
      ->capture_default_str();
  app.add_option("--width", arguments->width_in, "Width with --theme paper [in]")
      ->check(CLI::Range(2.0, 20.0))
      ->capture_default_str();
  app.add_option("--figure", arguments->ids, "Only the figures of these ids");
  app.add_option("--animate", arguments->animations,
                 "Animate the scenes of these ids, e.g. scene-forming-bearing, as ID.apng; without "
                 "--figure nothing else is drawn");
  add_jobs_option(app, arguments->jobs);
  return [arguments](const Invocation& invocation) { return render(*arguments, invocation); };
}

}  // namespace mapproof
