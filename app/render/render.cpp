#include "app/commands.hpp"

#include <algorithm>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/render/drawables.hpp"
#include "app/render/style_options.hpp"
#include "app/study/folder_report.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/text/spelling.hpp"
#include "core/base/text/words.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/output/write_scene.hpp"
#include "render/plot/layout.hpp"
#include "render/style/edits.hpp"
#include "render/style/words.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPanels = "panels";  ///< Id of the figure that --panel makes.

struct RenderArguments {
  std::string input;
  std::string out;
  std::vector<std::string> ids;
  std::vector<std::string> panels;
  std::vector<std::string> animations;
  std::vector<std::string> as;
  bool list = false;
  int jobs = 1;
  StyleArguments style;
};

/// What a file is written as, by the words of --as.
struct Formats {
  FileFormats files;
  std::set<AnimationFormat> animations;
  bool latex = false;
};

const std::vector<std::pair<std::string, FileFormat>>& file_formats() {
  static const std::vector<std::pair<std::string, FileFormat>> formats = {
      {"svg", FileFormat::kSvg},
      {"png", FileFormat::kPng},
      {"pdf", FileFormat::kPdf},
      {"eps", FileFormat::kEps},
      {"json", FileFormat::kJson},
      {"csv", FileFormat::kCsv},
      {"matplotlib", FileFormat::kMatplotlib}};
  return formats;
}

constexpr AnimationFormat kAnimationFormats[] = {AnimationFormat::kApng, AnimationFormat::kMp4,
                                                 AnimationFormat::kGif};

std::vector<std::string> format_words() {
  std::vector<std::string> words;
  for (const auto& [word, format] : file_formats()) words.push_back(word);
  words.emplace_back("latex");
  for (const AnimationFormat format : kAnimationFormats) words.emplace_back(name(format));
  return words;
}

/// Refuses an animation of what does not move. @throws InvalidInput naming what does.
[[noreturn]] void refuse_still(AnimationFormat format, const RenderArguments& arguments) {
  std::vector<std::string> moving;
  if (!arguments.input.empty())
    for (const Film& film : read_drawables(arguments.input).films) moving.push_back(film.id);
  throw InvalidInput(
      moving.empty()
          ? fmt::format("--as {}: nothing in {} moves: 3-D figures of studies do (`mapproof "
                        "reproduce`); a map is one still figure, of which svg, png, pdf and eps "
                        "can be had",
                        name(format), printable(arguments.input))
          : fmt::format("--as {}: only what --animate names is an animation; there are {}",
                        name(format), fmt::join(moving, ", ")));
}

Formats formats_of(const RenderArguments& arguments) {
  Formats formats;
  for (const std::string& word : arguments.as) {
    if (word == "latex") formats.latex = true;
    for (const auto& [known, format] : file_formats())
      if (word == known) formats.files.insert(format);
    for (const AnimationFormat format : kAnimationFormats)
      if (word == name(format)) formats.animations.insert(format);
  }
  if (formats.latex) formats.files.insert(FileFormat::kPdf);  // The snippet includes it.
  if (arguments.as.empty()) formats.files = usual_formats();
  const bool has_animation = !formats.animations.empty();
  if (has_animation && arguments.animations.empty())
    refuse_still(*formats.animations.begin(), arguments);
  if (formats.animations.empty()) formats.animations = {AnimationFormat::kApng};
  const bool is_alone = !arguments.animations.empty() && arguments.ids.empty();
  if (is_alone && !arguments.as.empty() && (!has_animation || !formats.files.empty()))
    throw InvalidInput(
        "--as: with --animate alone it is apng, mp4 or gif; name figures by --figure");
  return formats;
}

/// --list names the figures of INPUT as they are.
void refuse_idle_options_of_list(const RenderArguments& arguments) {
  const std::pair<const char*, bool> options[] = {
      {"--figure", !arguments.ids.empty()},
      {"--animate", !arguments.animations.empty()},
      {"--panel", !arguments.panels.empty()},
      {"--as", !arguments.as.empty()},
      {"--out", !arguments.out.empty()},
      {"--theme", arguments.style.theme.has_value()},
      {"--style and the like", arguments.style.changes_figures()}};
  for (const auto& [option, given] : options)
    if (given) throw InvalidInput(fmt::format("{}: has no effect on --list", option));
}

/// Options that would change nothing in these formats.
void refuse_idle_options(const StyleArguments& style, const Formats& formats,
                         const Drawables& drawables) {
  const bool has_animation = !drawables.films.empty();
  const auto has = [&](FileFormat format) { return formats.files.contains(format); };
  const bool is_drawn = has(FileFormat::kSvg) || has(FileFormat::kPng) || has(FileFormat::kPdf) ||
                        has(FileFormat::kEps) || has(FileFormat::kMatplotlib) || has_animation;
  const std::pair<const char*, bool> options[] = {
      {"--theme", style.theme.has_value()},
      {"--width", style.width_in.has_value()},
      {"--height", style.height_in.has_value()},
      {"--dpi", style.dpi.has_value()},
      {"--font", style.font.has_value()},
      {"--no-title", style.no_title},
      {"--title", style.title && !has(FileFormat::kJson)}};
  for (const auto& [option, given] : options)
    if (given && !is_drawn)
      throw InvalidInput(
          fmt::format("{}: has no effect on csv and json, which hold the data alone", option));
  if (style.font && has(FileFormat::kMatplotlib) && formats.files.size() == 1)
    throw InvalidInput("--font: a script of matplotlib chooses its font itself");
  const bool has_pixels = has(FileFormat::kPng) || has(FileFormat::kMatplotlib) || has_animation ||
                          !drawables.scenes.empty();
  if (style.dpi && !has_pixels) throw InvalidInput("--dpi: only png has pixels; add png to --as");
}

/// Each once, as it came first.
std::vector<std::string> without_repeats(const std::vector<std::string>& ids) {
  std::vector<std::string> once;
  for (const std::string& id : ids)
    if (std::ranges::find(once, id) == once.end()) once.push_back(id);
  return once;
}

/// "; did you mean "map"?" among the names, or the names.
std::string hint(const std::string& word, const std::vector<std::string>& names) {
  const std::string_view meant =
      likely_word(word, std::vector<std::string_view>(names.begin(), names.end()));
  if (!meant.empty()) return fmt::format("; did you mean \"{}\"?", meant);
  constexpr std::size_t kMost = 40;
  if (names.size() <= kMost) return fmt::format("; there are {}", fmt::join(names, ", "));
  return fmt::format("; there are {}, see --list", names.size());
}

/// Leaves what was asked for, in that order; all if nothing was.
void choose(const RenderArguments& arguments, Drawables& drawables) {
  std::vector<Film> films;
  std::vector<std::string> moving;
  for (const Film& film : drawables.films) moving.push_back(film.id);
  for (const std::string& id : without_repeats(arguments.animations)) {
    const auto found = std::ranges::find(drawables.films, id, &Film::id);
    if (found == drawables.films.end())
      throw InvalidInput(fmt::format("--animate: nothing moves in \"{}\" of {}{}", printable(id),
                                     arguments.input,
                                     moving.empty() ? "; no 3-D figure does" : hint(id, moving)));
    films.push_back(*found);
  }
  drawables.films = std::move(films);
  if (arguments.ids.empty() && arguments.animations.empty()) return;
  Drawables all{.root = {},
                .figures = std::move(drawables.figures),
                .scenes = std::move(drawables.scenes),
                .films = {}};
  drawables.figures.clear();
  drawables.scenes.clear();
  for (const std::string& id : without_repeats(arguments.ids)) {
    const auto figure = std::ranges::find(all.figures, id, &Figure::id);
    const auto scene = std::ranges::find(all.scenes, id, &Scene::id);
    if (figure != all.figures.end()) drawables.figures.push_back(*figure);
    if (scene != all.scenes.end()) drawables.scenes.push_back(*scene);
    if (figure == all.figures.end() && scene == all.scenes.end())
      throw InvalidInput(fmt::format("--figure: no figure \"{}\" in {}{}", printable(id),
                                     arguments.input, hint(id, ids_of(all))));
  }
}

/// The landmarks of all figures, each once.
std::vector<std::string> all_landmarks(const Drawables& drawables) {
  std::vector<std::string> names;
  for (const Figure& figure : drawables.figures)
    for (std::string& name : landmarks_of(figure)) names.push_back(std::move(name));
  return without_repeats(names);
}

void require_landmarks(const char* option, const std::vector<std::string>& asked,
                       const std::vector<std::string>& known) {
  if (known.empty())
    throw InvalidInput(fmt::format("{}: what is drawn shows no landmarks by name", option));
  for (const std::string& name : asked)
    if (std::ranges::find(known, name) == known.end())
      throw InvalidInput(
          fmt::format("{}: no landmark \"{}\"{}", option, printable(name), hint(name, known)));
}

void edit_landmarks(const StyleArguments& style, Drawables& drawables) {
  if (style.landmarks.empty() && style.only_landmarks.empty()) return;
  const std::vector<std::string> known = all_landmarks(drawables);
  if (!style.only_landmarks.empty()) {
    require_landmarks("--only-landmarks", style.only_landmarks, known);
    for (Figure& figure : drawables.figures) show_landmarks(figure, style.only_landmarks);
  }
  if (style.landmarks.empty()) return;
  const bool is_word = style.landmarks.size() == 1;
  const bool all = is_word && style.landmarks.front() == "all";
  const bool none = is_word && style.landmarks.front() == "none";
  require_landmarks("--landmarks", all || none ? std::vector<std::string>() : style.landmarks,
                    known);
  for (Figure& figure : drawables.figures)
    name_landmarks(figure, all ? known : none ? std::vector<std::string>() : style.landmarks);
}

std::vector<std::string> texts_of(Drawables drawables) {
  std::vector<std::string> texts;
  const auto add = [&](const std::string& text) { texts.push_back(text); };
  for (Figure& figure : drawables.figures) for_each_text(figure, add);
  for (Scene& scene : drawables.scenes) for_each_text(scene, add);
  for (Film& film : drawables.films)
    for (Scene& frame : film.frames) for_each_text(frame, add);
  return texts;
}

/// Titles, landmarks and words as they were asked for.
void edit(const StyleArguments& arguments, const FigureStyle& style, Drawables& drawables) {
  edit_landmarks(arguments, drawables);
  if (!style.words.empty())
    require_known_phrases(style, texts_of(drawables), arguments.file.value_or("--style"));
  for (Figure& figure : drawables.figures) replace_words(figure, style);
  for (Scene& scene : drawables.scenes) replace_words(scene, style);
  for (Film& film : drawables.films)
    for (Scene& frame : film.frames) replace_words(frame, style);
  if (!arguments.title) return;
  const std::size_t count =
      drawables.figures.size() + drawables.scenes.size() + drawables.films.size();
  if (count != 1)
    throw InvalidInput(fmt::format(
        "--title: {} figures are drawn, which would all get it; choose one by --figure", count));
  for (Figure& figure : drawables.figures) figure.title = *arguments.title;
  for (Scene& scene : drawables.scenes) scene.title = *arguments.title;
  for (Film& film : drawables.films)
    for (Scene& frame : film.frames) frame.title = *arguments.title;
}

/// Refuses images that would be too large before any file is written.
void require_sizes(const Drawables& drawables, const Formats& formats, const Theme& theme) {
  if (formats.files.contains(FileFormat::kPng))
    for (const Figure& figure : drawables.figures) require_image_size(lay_out(figure, theme));
  for (const Scene& scene : drawables.scenes) require_scene_size(scene, theme, formats.files);
  for (const Film& film : drawables.films) require_film_size(film, theme);
}

Drawables read_all(const RenderArguments& arguments) {
  if (arguments.input.empty() && arguments.panels.empty())
    throw InvalidInput("name what to draw: a folder, ID.figure.json or ID.scene.json");
  std::optional<Drawables> from;
  if (!arguments.input.empty()) from = read_drawables(arguments.input);
  if (arguments.panels.empty()) {
    choose(arguments, *from);
    return std::move(*from);
  }
  if (!arguments.ids.empty() || !arguments.animations.empty())
    throw InvalidInput("--panel: makes one figure; leave out --figure and --animate");
  if (!from && arguments.out.empty())
    throw InvalidInput("--panel: name the folder for the figure by --out");
  std::vector<Figure> figures;
  for (const std::string& panel : arguments.panels) figures.push_back(panel_figure(panel, from));
  // Figures of one title are distinguished by where they are from.
  std::vector<std::string> titles(figures.size());
  for (std::size_t i = 0; i < figures.size(); ++i)
    if (std::ranges::count(figures, figures[i].title, &Figure::title) > 1)
      titles[i] = fmt::format("{} ({})", figures[i].title, arguments.panels[i]);
  Drawables joined{
      .root = from ? from->root : fs::path("."), .figures = {}, .scenes = {}, .films = {}};
  joined.figures.push_back(joined_figure(kPanels, figures, titles));
  return joined;
}

/// The folder below the root for what is drawn without --out: figures/ as reports have them; what
/// is drawn otherwise goes beside it.
fs::path inner_folder(const RenderArguments& arguments, const FigureStyle& style) {
  if (!arguments.out.empty()) return "";
  if (style.theme == BaseTheme::kPaper) return "figures-paper";
  const bool is_own = arguments.style.changes_figures() || !arguments.panels.empty();
  return is_own ? "figures-styled" : "figures";
}

int list(const Drawables& drawables, const Invocation& invocation) {
  nlohmann::ordered_json object{{"figures", nlohmann::ordered_json::array()}};
  std::string text;
  const auto add = [&](const std::string& id, const std::string& title, const char* kind) {
    object["figures"].push_back({{"id", id}, {"kind", kind}, {"title", title}});
    text += fmt::format("{}  {}: {}\n", id, kind, printable(title));
  };
  for (const Figure& figure : drawables.figures) add(figure.id, figure.title, "figure");
  for (const Scene& scene : drawables.scenes) add(scene.id, scene.title, "scene");
  for (const Film& film : drawables.films) add(film.id, film.frames.back().title, "animation");
  invocation.console.result(text, object);
  return kDone;
}

/// The names of the files of one image, for the result.
std::string files_text(const fs::path& folder, const std::string& id, const Formats& formats) {
  std::string text;
  const auto add = [&](const std::string& ending) {
    text += (folder / (id + ending)).string() + "\n";
  };
  if (formats.files == usual_formats()) {
    add(".svg");
    return text;
  }
  for (const auto& [word, format] : file_formats())
    if (formats.files.contains(format))
      add(format == FileFormat::kMatplotlib ? ".py"
          : format == FileFormat::kJson     ? ".*.json"
                                            : "." + word);
  if (formats.latex) add(".tex");
  return text;
}

/// The caption, with the notes that the figure does not show. @param drawn  Whether it shows them.
std::string caption_of(const std::string& caption, const std::vector<Note>& notes, bool drawn) {
  std::string text = caption;
  for (const Note& note : notes) {
    constexpr std::string_view kSign = "\u26A0 ";
    std::string_view words = note.text;
    if (words.starts_with(kSign)) words.remove_prefix(kSign.size());
    if (!drawn && text.find(words) == std::string::npos) text += fmt::format(" {}", words);
  }
  return text;
}

/// Says what a figure does not show in this theme.
void report_notes(const Drawables& drawables, const Theme& theme, const Console& console) {
  for (const Figure& figure : drawables.figures)
    for (const Note& note : figure.notes)
      if (note.colour == ThemeColour::kWarning && !draws_notes(figure, theme))
        console.info(fmt::format("{}: for the caption: {}", figure.id, note.text));
}

/// Names beside points of a figure that find no room in it.
std::vector<std::string> names_without_room(const Figure& figure, const Theme& theme) {
  std::multiset<std::string> drawn;
  for (const Item& item : lay_out(figure, theme).items)
    if (const auto* line = std::get_if<TextLine>(&item.what);
        line != nullptr && item.item_class == ItemClass::kMarkLabel)
      drawn.insert(line->whole.empty() ? line->shaped.text : line->whole);
  std::vector<std::string> names;
  for (const Panel& panel : figure.panels)
    for (const Layer& layer : panel.layers)
      if (const auto* labels = std::get_if<PointLabels>(&layer))
        for (const std::string& name : labels->text)
          if (drawn.extract(name).empty()) names.push_back(name);
  return names;
}

/// Says which of the landmarks that are to be named are not.
void report_names(const RenderArguments& arguments, const Drawables& drawables, const Theme& theme,
                  const Console& console) {
  constexpr std::size_t kMost = 10;
  if (arguments.style.landmarks.empty()) return;
  for (const Figure& figure : drawables.figures)
    if (const auto names = names_without_room(figure, theme); !names.empty())
      console.info(fmt::format("{}: no room for the names of {}; a larger --width has more",
                               figure.id, printable(listed(names, kMost), 1000)));
}

void write_latex(const Drawables& drawables, const Theme& theme, const OutputFolder& folder) {
  for (const Figure& figure : drawables.figures)
    folder.write(figure.id + ".tex",
                 figure_latex(figure.id,
                              caption_of(figure.caption, figure.notes, draws_notes(figure, theme)),
                              theme.width_pt));
  for (const Scene& scene : drawables.scenes)
    folder.write(scene.id + ".tex",
                 figure_latex(scene.id, caption_of(scene.caption, scene.notes, theme.draws_notes),
                              theme.width_pt));
}

void write_films(const Drawables& drawables, const DrawingJob& job, const Formats& formats,
                 SceneClient& client, const Console& console) {
  for (const Film& film : drawables.films) {
    const CountProgress progress = count_progress(console, "drawing frame");
    write_animation(film, job.theme, job.folder, client,
                    {.formats = formats.animations,
                     .drawn = [&](std::size_t done) { progress(done, film.frames.size()); }});
  }
}

int render(const RenderArguments& arguments, const Invocation& invocation) {
  if (arguments.list) {
    refuse_idle_options_of_list(arguments);
    return list(read_drawables(arguments.input), invocation);
  }
  const Formats formats = formats_of(arguments);
  const FigureStyle style = style_of(arguments.style);
  const Theme theme = theme_of(style);
  Drawables drawables = read_all(arguments);
  refuse_idle_options(arguments.style, formats, drawables);
  edit(arguments.style, style, drawables);
  if (arguments.style.changes_figures() || !arguments.panels.empty())
    require_sizes(drawables, formats, theme);
  // Commands that make the map or the study again hold the lock of its folder.
  const LockedFolder out(arguments.out.empty() ? drawables.root : fs::path(arguments.out));
  const fs::path inner = inner_folder(arguments, style);
  const OutputFolder files = inner.empty() ? out.files() : out.files() / inner;
  const fs::path folder = files.path();

  Images images;
  for (const Figure& figure : drawables.figures) images.figures.push_back(&figure);
  for (const Scene& scene : drawables.scenes) images.scenes.push_back(&scene);
  SceneClient client;  // One program draws scenes and films.
  DrawingJob job{.folder = files,
                 .theme = theme,
                 .jobs = arguments.jobs,
                 .formats = formats.files,
                 .progress = count_progress(invocation.console, "drawing")};
  const Drawn drawn = write_images(images, job, client);
  job.progress = nullptr;
  report_notes(drawables, theme, invocation.console);
  report_names(arguments, drawables, theme, invocation.console);
  if (!drawn.scene_error.empty()) throw SceneError(drawn.scene_error);
  if (formats.latex) write_latex(drawables, theme, files);
  write_films(drawables, job, formats, client, invocation.console);

  nlohmann::ordered_json object{{"input", arguments.input},
                                {"folder", folder.string()},
                                {"figures", nlohmann::ordered_json::array()}};
  std::string text;
  for (const std::string& id : ids_of(drawables)) {
    object["figures"].push_back(id);
    text += files_text(folder, id, formats);
  }
  for (const Film& film : drawables.films) {
    object["animations"].push_back(film.id);
    for (const AnimationFormat format : formats.animations)
      text += (folder / fmt::format("{}.{}", film.id, name(format))).string() + "\n";
  }
  invocation.console.result(text, object);
  return kDone;
}

}  // namespace

Action render_command(CLI::App& app) {
  auto arguments = std::make_shared<RenderArguments>();
  app.description(
      "Draw figures again, in another style, size or format: those of a map, a range-only map, a "
      "study or a file");
  app.footer(
      "Examples:\n"
      "  mapproof render out/map --theme paper --width 3.25\n"
      "  mapproof render out/map --figure map --landmarks all --title \"Hall\" --as png --dpi 600\n"
      "  mapproof render out/map/figures/map.figure.json --style style.json\n"
      "  mapproof render report.html --figure map-bearing-isomap --out figures\n"
      "  mapproof render --panel out/map1 out/map2 --out out/both\n"
      "  mapproof render out --figure map-bearing-isomap --as pdf,latex\n"
      "  mapproof render out --figure map-bearing-isomap --as csv,matplotlib\n"
      "  mapproof render out --animate scene-forming-bearing --as mp4\n");
  app.add_option("INPUT", arguments->input,
                 "Folder of a study, a map or a range-only map, the page of its report, ID.figure.json "
                 "or ID.scene.json")
      ->check(names_folder())
      ->group("Input");
  app.add_option("--figure", arguments->ids, "Only the figures of these ids, see --list")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("IDS")
      ->group("Input");
  app.add_option("--panel", arguments->panels,
                 "Draw several figures as panels of one, with the same limits: folders of maps, "
                 "files, or ids of figures in INPUT")
      ->expected(2, 100)
      ->type_name("INPUT")
      ->group("Input");
  app.add_option(
         "--animate", arguments->animations,
         "Animate the 3-D figures of these ids, e.g. scene-forming-bearing; without --figure "
         "nothing else is drawn")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("IDS")
      ->group("Input");
  app.add_flag("--list", arguments->list, "List the ids of what can be drawn")->group("Input");
  add_style_options(app, arguments->style);
  app.add_option(
         "--as", arguments->as,
         "Formats: svg, png, pdf, eps, json, csv (the data), matplotlib (a script), latex "
         "(a figure to \\input); of animations apng, mp4, gif. By default svg, png, pdf and "
         "json; apng")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("FORMATS")
      ->transform(one_of(format_words()))
      ->group("Output");
  add_out_option(app, arguments->out,
                 "Folder for the figures. By default figures in that of INPUT, figures-paper with "
                 "the theme paper, figures-styled with any other change")
      ->group("Output");
  add_jobs_option(app, arguments->jobs);
  return [arguments](const Invocation& invocation) { return render(*arguments, invocation); };
}

}  // namespace mapproof
