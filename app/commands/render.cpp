#include <algorithm>
#include <iterator>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands/verbs.hpp"
#include "app/folder_report.hpp"
#include "core/base/errors.hpp"

namespace mapproof {
namespace {

struct Arguments {
  std::string study;
  std::string out;
  std::string theme = "report";
  double width_in = 3.25;
  std::vector<std::string> ids;
  int jobs = 1;
};

std::vector<std::string> ids_of(const Pictures& pictures) {
  std::vector<std::string> ids;
  for (const Figure* figure : pictures.figures) ids.push_back(figure->id);
  for (const Scene* scene : pictures.scenes) ids.push_back(scene->id);
  return ids;
}

/// Those of the ids that were asked for, all if none was.
Pictures chosen_pictures(const Arguments& arguments, const FolderReport& view) {
  const Pictures all = pictures_of(view);
  if (arguments.ids.empty()) return all;
  Pictures chosen;
  for (const std::string& id : arguments.ids) {
    const auto is_it = [&id](const auto* picture) { return picture->id == id; };
    const std::size_t before = chosen.figures.size() + chosen.scenes.size();
    std::ranges::copy_if(all.figures, std::back_inserter(chosen.figures), is_it);
    std::ranges::copy_if(all.scenes, std::back_inserter(chosen.scenes), is_it);
    if (chosen.figures.size() + chosen.scenes.size() > before) continue;
    throw InvalidInput(fmt::format("--figure: no figure \"{}\" in {}; there are {}", printable(id),
                                   arguments.study, fmt::join(ids_of(all), ", ")));
  }
  return chosen;
}

int render(const Arguments& arguments, const Invocation& invocation) {
  const FolderReport view = read_folder_report(arguments.study, std::nullopt, "");
  const Pictures pictures = chosen_pictures(arguments, view);
  const bool paper = arguments.theme == "paper";
  const std::filesystem::path folder = arguments.out.empty()
                                           ? view.folder / (paper ? "figures-paper" : "figures")
                                           : std::filesystem::path(arguments.out);
  write_pictures(pictures, paper ? paper_theme(arguments.width_in) : report_theme(), folder,
                 arguments.jobs);

  nlohmann::ordered_json object{{"study", arguments.study}, {"folder", folder.string()}};
  std::string text;
  for (const std::string& id : ids_of(pictures)) {
    object["figures"].push_back(id);
    text += (folder / (id + ".svg")).string() + "\n";
  }
  invocation.console.result(text, object);
  return kDone;
}

}  // namespace

Action render_verb(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  app.description("Draw a study's figures again from its records: SVG, PNG, PDF");
  app.footer(
      "Examples:\n"
      "  mapproof render out\n"
      "  mapproof render out --theme paper --width 6.75 --figure map-bearing-isomap\n");
  app.add_option("DIR", arguments->study, "The study's folder")->required();
  add_out_option(app, arguments->out,
                 "Folder for the figures (default: DIR/figures, DIR/figures-paper)");
  app.add_option("--theme", arguments->theme, "report (screen) or paper (8 pt, 300 dpi)")
      ->check(CLI::IsMember({"report", "paper"}))
      ->capture_default_str();
  app.add_option("--width", arguments->width_in, "Width with --theme paper [in]")
      ->check(CLI::Range(2.0, 20.0))
      ->capture_default_str();
  app.add_option("--figure", arguments->ids, "Only the figures of these ids");
  add_jobs_option(app, arguments->jobs);
  return [arguments](const Invocation& invocation) { return render(*arguments, invocation); };
}

}  // namespace mapproof
