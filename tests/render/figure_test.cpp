#include "render/plot/figure.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/plot/figure_json.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

Figure small() {
  Figure figure;
  figure.id = "small";
  figure.panels.resize(1);
  figure.panels[0].layers = {
      Polyline{.x = {1.0, 2.0}, .y = {1.0, 3.0}, .mark = {"line", {{"key", "value"}}}},
      Scatter{.x = {1.0}, .y = {2.0}, .marks = {Mark{"dot", {}}}}};
  return figure;
}

std::string message_of(const std::string& text) {
  try {
    figure_from_json(text, "f.json");
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? "" : text.replace(at, from.size(), to);
}

TEST(Figure, OfSoundPartsHasNoProblem) { EXPECT_EQ(problem(small()), ""); }

TEST(Figure, NamesThePlaceOfWhatIsWrong) {
  Figure figure = small();
  std::get<Polyline>(figure.panels[0].layers[0]).y.pop_back();
  EXPECT_EQ(problem(figure), "panels/0/layers/0/y: not as long as x");
  figure = small();
  std::get<Scatter>(figure.panels[0].layers[1]).marks[0].id = "line";
  EXPECT_EQ(problem(figure), "panels/0/layers/1/mark: id 'line' is there twice");
  figure = small();
  figure.panels[0].y.scale = Scale::kLog;
  std::get<Scatter>(figure.panels[0].layers[1]).y[0] = 0.0;
  EXPECT_EQ(problem(figure), "panels/0/layers/1/y/0: not positive on a log axis");
  figure = small();
  figure.panels[0].x.limits = Range{2.0, 2.0};
  EXPECT_EQ(problem(figure), "panels/0/x/limits: not finite and ascending");
  figure = small();
  std::get<Scatter>(figure.panels[0].layers[1]).x[0] = INFINITY;
  EXPECT_EQ(problem(figure), "panels/0/layers/1/x/0: infinite");
}

TEST(Figure, RefusesCellsThatTheirScaleAndTextsDoNotFit) {
  const Cells sound{.x = {0.0, 1.0},
                    .y = {0.0, 1.0},
                    .columns = 2,
                    .values = {1.0, 2.0},
                    .colour_scale = {.limits = {1.0, 2.0}}};
  const auto problem_with = [](const Cells& cells) {
    Figure figure = small();
    figure.panels[0].layers = {cells};
    return problem(figure);
  };
  EXPECT_EQ(problem_with(sound), "");
  Cells cells = sound;
  cells.text = {"1"};
  EXPECT_EQ(problem_with(cells), "panels/0/layers/0/text: not as many as values");
  cells = sound;
  cells.colour_scale.scale = Scale::kLog;
  EXPECT_EQ(problem_with(cells), "");
  cells.colour_scale.limits.low = 0.0;
  EXPECT_EQ(problem_with(cells), "panels/0/layers/0/limits: not positive on a log scale");
  Figure figure = small();
  figure.panels[0].x.scale = Scale::kLog;
  figure.panels[0].x.names = {"a"};
  EXPECT_EQ(problem(figure), "panels/0/x/names: on a log axis");
}

TEST(Figure, RefusesAColouredLineWithoutAValuePerPointOrARange) {
  const Polyline sound{.x = {0.0, 1.0, 2.0},
                       .y = {0.0, 1.0, NAN},
                       .values = {1.0, NAN, 2.0},
                       .colour_scale = {.limits = {1.0, 2.0}}};
  const auto problem_with = [](const Polyline& line) {
    Figure figure = small();
    figure.panels[0].layers = {line};
    return problem(figure);
  };
  EXPECT_EQ(problem_with(sound), "");
  Polyline line = sound;
  line.values.pop_back();
  EXPECT_EQ(problem_with(line), "panels/0/layers/0/values: not as many as x");
  line = sound;
  line.colour_scale.limits = {2.0, 2.0};
  EXPECT_EQ(problem_with(line), "panels/0/layers/0/limits: not finite and ascending");
  line.values.clear();
  EXPECT_EQ(problem_with(line), "");
}

TEST(Figure, RefusesIdsThatAreNoFileNames) {
  for (const std::string id : {"", "Big", "a/b", "..", "1st", "a_b", "a b", "\u00E9"}) {
    Figure figure = small();
    figure.id = id;
    EXPECT_NE(problem(figure), "") << id;
  }
  Figure figure = small();
  figure.id = std::string(121, 'a');
  EXPECT_NE(problem(figure), "");
}

TEST(Figure, RefusesDataNamesThatAreNoAttributeNames) {
  Figure figure = small();
  std::get<Polyline>(figure.panels[0].layers[0]).mark.data[0].first = "x\" onload=\"";
  EXPECT_NE(problem(figure), "");
}

TEST(Figure, RefusesSizesThatCannotBeDrawn) {
  for (const double size : {0.0, -1.0, 1e9, std::nan("")}) {
    Figure figure = small();
    std::get<Polyline>(figure.panels[0].layers[0]).width = size;
    EXPECT_EQ(problem(figure), "panels/0/layers/0/width: not in (0, 100]") << size;
  }
}

TEST(FigureJson, RoundTripsEveryFigure) {
  for (const Figure& figure : sample_figures()) {
    const std::string text = figure_to_json(figure);
    const Figure back = figure_from_json(text, "figure.json");
    EXPECT_EQ(figure_to_json(back), text) << figure.id;
    EXPECT_EQ(back.id, figure.id);
    EXPECT_EQ(back.panels.size(), figure.panels.size());
  }
}

TEST(FigureJson, KeepsEveryBitOfANumber) {
  Figure figure = small();
  auto& y = std::get<Polyline>(figure.panels[0].layers[0]).y;
  y = {0.1 + 0.2, std::numeric_limits<double>::denorm_min()};
  EXPECT_EQ(figure_from_json(figure_to_json(figure), "f"), figure);
}

TEST(FigureJson, ReadsNullAsNotANumber) {
  Figure figure = small();
  std::get<Polyline>(figure.panels[0].layers[0]).y[1] = NAN;
  const Figure back = figure_from_json(figure_to_json(figure), "f");
  EXPECT_TRUE(std::isnan(std::get<Polyline>(back.panels[0].layers[0]).y[1]));
}

TEST(FigureJson, NamesThePlaceOfWhatItCannotRead) {
  const std::string text = figure_to_json(small());
  EXPECT_EQ(message_of("{"),
            "f.json: line 1, column 2: the file is truncated: it ends within a value");
  EXPECT_EQ(message_of("[1e999]"),
            "f.json: line 1, column 6: the number \"1e999\" is beyond what a double holds");
  EXPECT_TRUE(message_of("[]").starts_with("f.json: /: does not state its format"));
  EXPECT_EQ(message_of(replaced(text, "\"alt\"", "\"other\"")), "f.json: /: unknown key \"other\"");
  EXPECT_EQ(message_of(replaced(text, "mapproof.figure", "other")),
            "f.json: /schema/name: expected \"mapproof.figure\", got \"other\"");
  EXPECT_EQ(
      message_of(replaced(text, "\"version\": 1", "\"version\": 2")),
      "f.json: /schema/version: version 2 is not known to this program, which reads version 1");
  EXPECT_EQ(message_of(replaced(text, "\"polyline\"", "\"pie\"")),
            "f.json: /panels/0/layers/0/kind: the kind \"pie\" is unknown");
  EXPECT_EQ(message_of(replaced(text, "\"colour\": \"series1\"", "\"colour\": 3")),
            "f.json: /panels/0/layers/0/colour: expected a string, got 3");
  EXPECT_EQ(
      message_of(replaced(text, "\"colour\": \"series1\"", "\"colour\": \"serie1\"")),
      "f.json: /panels/0/layers/0/colour: unknown colour \"serie1\": did you mean \"series1\"?");
  EXPECT_EQ(message_of(replaced(text, "\"id\": \"small\"", "\"id\": \"../x\"")),
            "f.json: /id: expected a letter a-z and then up to 119 of a-z, 0-9 and '-', got "
            "\"../x\"");
}

}  // namespace
}  // namespace mapproof::test
