#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "render/plot/layout.hpp"
#include "render/style/edits.hpp"
#include "render/style/figure_style.hpp"
#include "render/style/figure_style_fields.hpp"
#include "render/style/words.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

Figure map_sample() {
  for (Figure& figure : sample_figures())
    if (figure.panels.size() == 1 && landmarks_of(figure).size() >= 10) return figure;
  throw InvalidInput("no sample shows ten landmarks");
}

const PointLabels* labels_of(const Figure& figure) {
  const PointLabels* found = nullptr;
  for (const Layer& layer : figure.panels.front().layers)
    if (const auto* labels = std::get_if<PointLabels>(&layer)) found = labels;
  return found;
}

constexpr const char* kHead = R"({"schema": {"name": "mapproof.style", "version": 1}, )";

TEST(FigureStyle, FillsOneTheme) {
  const TemporaryFolder folder;
  const auto file = folder.file(
      "style.json", std::string(kHead) + R"("theme": "paper", "width_in": 4, "height_in": 3,
      "dpi": 200, "draws_title": true, "font_pt": 9, "colours": {"text": "#102030",
      "series": ["#445566"]}, "words": {"estimate": "map"}})");
  const FigureStyle style = read_figure_style(file);
  const Theme theme = theme_of(style);
  EXPECT_EQ(theme.width_pt, 288.0);
  EXPECT_EQ(theme.height_pt, 216.0);
  EXPECT_EQ(theme.dpi, 200.0);
  EXPECT_TRUE(theme.draws_title);
  EXPECT_EQ(theme.font_pt, 9.0);
  EXPECT_EQ(hex(theme.text), "#102030");
  EXPECT_EQ(hex(theme.series[0]), "#445566");
  EXPECT_EQ(theme.series[1], paper_theme(3.25).series[1]);
  EXPECT_EQ(words_of(style).at("estimate"), "map");
}

TEST(FigureStyle, OfNothingIsTheTheme) {
  const Theme theme = theme_of({});
  EXPECT_EQ(theme.width_pt, report_theme().width_pt);
  EXPECT_EQ(theme.height_pt, report_theme().height_pt);
  const Theme wide = theme_of({.width_in = 12.0});
  EXPECT_NEAR(wide.height_pt / wide.width_pt, 0.75, 1e-12) << "as high for its width";
}

TEST(FigureStyle, RefusesWhatIsNoneWithTheLocation) {
  const TemporaryFolder folder;
  for (const auto& [text, said] :
       {std::pair{R"("colours": {"text": "red"}})", "/colours/text"},
        {R"("dpi": 5})", "/dpi"},
        {R"("colour": {}})", "did you mean \"colours\"?"},
        {R"("theme": "papr"})", "expected report, dark or paper, got \"papr\""}}) {
    const auto file = folder.file("style.json", std::string(kHead) + text);
    try {
      read_figure_style(file);
      ADD_FAILURE() << text;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
  const auto text = folder.file("font.ttf", "no font");
  EXPECT_THROW(theme_of({.font = text.string()}), InvalidInput);
  EXPECT_THROW(words_of({.language = "tlh"}), InvalidInput);
}

TEST(FigureStyle, DrawsAllTextsInItsFont) {
  const TemporaryFolder folder;
  const auto file = folder.file("own.ttf", std::string(font_bytes()));
  Theme theme = report_theme();
  const Drawing usual = lay_out(map_sample(), theme);
  theme = theme_of({.font = file.string()});
  ASSERT_NE(theme.font, nullptr);
  const Drawing own = lay_out(map_sample(), theme);
  EXPECT_EQ(own.font, theme.font);
  // The same font from a file sets the same glyphs at the same places.
  ASSERT_EQ(own.items.size(), usual.items.size());
  for (std::size_t i = 0; i < own.items.size(); ++i)
    if (const auto* line = std::get_if<TextLine>(&own.items[i].what)) {
      const auto& other = std::get<TextLine>(usual.items[i].what);
      EXPECT_EQ(line->shaped.text, other.shaped.text);
      EXPECT_EQ(line->at.x, other.at.x);
    }
}

TEST(Words, ReplaceWholePhrasesTheLongestFirstAndNoneTwice) {
  const std::map<std::string, std::string> words = {
      {"error", "Fehler"}, {"error of the mean", "Fehler des Mittels"}, {"Fehler", "wrong"}};
  EXPECT_EQ(replaced("error of the mean, error; errors terror", words),
            "Fehler des Mittels, Fehler; errors terror");
  EXPECT_EQ(replaced("", words), "");
  EXPECT_EQ(replaced("Türerror", {{"error", "x"}}), "Türerror") << "a letter beyond ASCII";
}

TEST(Words, OfALanguageReachLegendAndAxesButNoNames) {
  for (const std::string_view language : languages()) {
    Figure figure = map_sample();
    const Figure before = figure;
    replace_words(figure, FigureStyle{.language = std::string(language)});
    EXPECT_EQ(problem(figure), "") << language;
    EXPECT_EQ(landmarks_of(figure), landmarks_of(before));
    EXPECT_EQ(figure == before, language == "en") << language;
  }
}

TEST(Landmarks, AreNamedAsAsked) {
  Figure figure = map_sample();
  const std::vector<std::string> all = landmarks_of(figure);
  name_landmarks(figure, {all[1], all[3]});
  ASSERT_NE(labels_of(figure), nullptr);
  std::vector<std::string> named = labels_of(figure)->text;
  std::ranges::sort(named);
  std::vector<std::string> expected = {all[1], all[3]};
  std::ranges::sort(expected);
  EXPECT_EQ(named, expected);
  name_landmarks(figure, all);
  EXPECT_EQ(labels_of(figure)->text.size(), all.size());
  name_landmarks(figure, {});
  EXPECT_EQ(labels_of(figure), nullptr);
  EXPECT_EQ(problem(figure), "");
}

TEST(Landmarks, ThatAreNotAskedForAreNotShown) {
  Figure figure = map_sample();
  const std::vector<std::string> all = landmarks_of(figure);
  show_landmarks(figure, {all[0], all[2]});
  EXPECT_EQ(problem(figure), "");
  std::vector<std::string> left = landmarks_of(figure);
  std::ranges::sort(left);
  std::vector<std::string> expected = {all[0], all[2]};
  std::ranges::sort(expected);
  EXPECT_EQ(left, expected);
}

TEST(JoinedFigure, HasThePanelsOfAllWithTheSameLimits) {
  const Figure one = map_sample();
  Figure other = one;
  other.title = "Another map";
  for (Layer& layer : other.panels.front().layers)
    if (auto* points = std::get_if<Scatter>(&layer))
      for (double& x : points->x) x += 100.0;
  const Figure joined = joined_figure("panels", {one, other});
  ASSERT_EQ(joined.panels.size(), 2U);
  EXPECT_TRUE(joined.shared_x && joined.shared_y);
  EXPECT_TRUE(joined.panels[0].title.starts_with(one.title));
  EXPECT_TRUE(joined.panels[1].title.starts_with("Another map"));
  const Drawing drawing = lay_out(joined, report_theme());
  ASSERT_EQ(drawing.frames.size(), 2U);
  EXPECT_NEAR(drawing.frames[0].width(), drawing.frames[1].width(), 1e-9);
  Figure differs = other;
  differs.panels.front().x.label = "x [ft]";
  EXPECT_FALSE(joined_figure("panels", {one, differs}).shared_x);
  EXPECT_THROW(joined_figure("panels", {one}), InvalidInput);
}

}  // namespace
}  // namespace mapproof::test
