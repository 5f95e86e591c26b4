#include "app/render/style_options.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "render/style/figure_style_fields.hpp"
#include "render/style/words.hpp"

namespace mapproof {
namespace {

/// Takes a length with a unit, and makes it inches.
CLI::Validator length_in_inches() {
  return {[](std::string& text) -> std::string {
            constexpr std::pair<std::string_view, double> kUnits[] = {
                {"", 1.0}, {"in", 1.0}, {"\"", 1.0}, {"cm", 2.54}, {"mm", 25.4}, {"pt", 72.0}};
            const std::string word = lower_case(trimmed(text));
            const std::size_t end = word.find_last_of("0123456789.") + 1;
            const std::optional<double> number = number_in(word.substr(0, end));
            const auto* unit =
                std::ranges::find(kUnits, trimmed(std::string_view(word).substr(end)),
                                  [](const auto& known) { return known.first; });
            if (!number || !std::isfinite(*number) || unit == std::end(kUnits))
              return fmt::format(
                  "\"{}\" is not a length: inches (3.25), or a unit behind it (3.25in, 8cm, 82mm, "
                  "234pt)",
                  printable(text));
            text = fmt::format("{}", *number / unit->second);
            return "";
          },
          ""};
}

}  // namespace

bool StyleArguments::changes_figures() const {
  return file || theme.value_or("report") != "report" || title || no_title || font || language ||
         width_in || height_in || dpi || !landmarks.empty() || !only_landmarks.empty();
}

void add_style_options(CLI::App& app, StyleArguments& arguments) {
  const std::string group = "Style";
  app.add_option("--theme", arguments.theme,
                 "report: for screens, 8.33 in wide, with a title. dark: the same in light colours "
                 "on a dark ground. paper: for a column of a journal, 3.25 in wide, 8 pt, 300 dpi, "
                 "without a title. The default is report")
      ->transform(one_of({"report", "dark", "paper"}))
      ->group(group);
  app.add_option("--width", arguments.width_in,
                 "Width of the figure in inches, or with a unit, as 8cm, 82mm or 234pt")
      ->transform(length_in_inches())
      ->check(number_in(2.0, 20.0))
      ->group(group);
  app.add_option("--height", arguments.height_in,
                 "Height of the figure, as for --width; of several panels, of one row")
      ->transform(length_in_inches())
      ->check(number_in(1.0, 20.0))
      ->group(group);
  app.add_option("--dpi", arguments.dpi, "Pixels per inch of PNG and of animations")
      ->check(number_in(30.0, 1200.0))
      ->group(group);
  auto* title =
      app.add_option("--title", arguments.title, "Title of the figure, instead of its own")
          ->group(group);
  app.add_flag("--no-title", arguments.no_title, "Draw no title")->excludes(title)->group(group);
  app.add_option("--landmarks", arguments.landmarks,
                 "Landmarks that are named in maps: a list a,b,..., or all, or none. By default "
                 "those with the largest errors")
      ->delimiter(',')
      ->type_name("NAMES")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--only-landmarks", arguments.only_landmarks,
                 "Show these landmarks of maps and no others: a list a,b,...")
      ->delimiter(',')
      ->type_name("NAMES")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--font", arguments.font, "TrueType or OpenType file, instead of DejaVu Sans")
      ->type_name("FILE")
      ->group(group);
  std::vector<std::string> known;
  for (const std::string_view language : languages()) known.emplace_back(language);
  app.add_option("--language", arguments.language, "Language of the words in figures")
      ->transform(one_of(known))
      ->group(group);
  app.add_option("--style", arguments.file,
                 "File of colours, sizes, font, language and words (docs/figures.md); what is "
                 "typed replaces what is in it")
      ->type_name("FILE")
      ->group(group);
}

FigureStyle style_of(const StyleArguments& arguments) {
  FigureStyle style = arguments.file ? read_figure_style(*arguments.file) : FigureStyle{};
  if (arguments.theme)
    style.theme = *arguments.theme == "paper"  ? BaseTheme::kPaper
                  : *arguments.theme == "dark" ? BaseTheme::kDark
                                               : BaseTheme::kReport;
  if (arguments.width_in) style.width_in = arguments.width_in;
  if (arguments.height_in) style.height_in = arguments.height_in;
  if (arguments.dpi) style.dpi = arguments.dpi;
  if (arguments.font) style.font = *arguments.font;
  if (arguments.language) style.language = *arguments.language;
  if (arguments.title) style.draws_title = true;
  if (arguments.no_title) style.draws_title = false;
  return style;
}

}  // namespace mapproof
