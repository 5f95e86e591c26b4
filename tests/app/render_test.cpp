#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples = MAPPROOF_SOURCE_DIR "/examples";

/// A map of the examples' bearings.
class RenderOfAMap : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string files = std::string(kExamples) + "/hall";
    const Outcome made =
        mapproof({"map", files + "/bearings.csv", "--sensor", "bearing", "--method", "lpca",
                  "--anchors", files + "/anchors.csv", "--out", map_});
    ASSERT_EQ(made.exit_code, 0) << made.error;
  }

  Outcome render(std::vector<std::string> words) {
    words.insert(words.begin(), "render");
    return mapproof(words);
  }

  std::string text_of(const std::string& file) { return read_file(folder_ / file); }

  TemporaryFolder folder_;
  std::string map_ = folder_ / "map";
};

TEST_F(RenderOfAMap, GivesTheSameBytesAsTheMapInItsOwnStyle) {
  const Contents before = contents(map_);
  const Outcome outcome = render({map_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  expect_same(contents(map_), before);
}

TEST_F(RenderOfAMap, DrawsItForAColumnOfAPaper) {
  const Outcome outcome =
      render({map_, "--theme", "paper", "--width", "3.25", "--as", "pdf,eps,latex"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  if (fs::exists("/usr/bin/pdfinfo")) {
    const Outcome facts = run_program({"/usr/bin/pdfinfo", map_ + "/figures-paper/map.pdf"});
    EXPECT_NE(facts.out.find(" 234 x "), std::string::npos) << facts.out << facts.error;
  }
  EXPECT_NE(text_of("map/figures-paper/map.tex").find("\\includegraphics[width=3.25in]{map.pdf}"),
            std::string::npos);
  EXPECT_TRUE(text_of("map/figures-paper/map.eps").starts_with("%!PS-Adobe"));
  EXPECT_FALSE(fs::exists(folder_ / "map/figures-paper/map.svg"));
}

TEST_F(RenderOfAMap, OnPaperItsScoreIsInTheCaptionAlone) {
  const std::string files = std::string(kExamples) + "/hall";
  ASSERT_EQ(mapproof({"map", files + "/bearings.csv", "--sensor", "bearing", "--method", "lpca",
                      "--anchors", files + "/anchors.csv", "--ground-truth",
                      files + "/ground_truth.csv", "--force", "--out", map_})
                .exit_code,
            0);
  ASSERT_EQ(render({map_, "--figure", "map", "--theme", "paper", "--as", "svg,latex,matplotlib"})
                .exit_code,
            0);
  EXPECT_NE(text_of("map/figures/map.svg").find("class=\"note\""), std::string::npos);
  EXPECT_EQ(text_of("map/figures-paper/map.svg").find("class=\"note\""), std::string::npos);
  EXPECT_EQ(text_of("map/figures-paper/map.py").find("suptitle(\"MPE"), std::string::npos);
}

TEST_F(RenderOfAMap, TakesLengthsWithUnits) {
  for (const auto& [width, points] :
       {std::pair("8cm", "226.77"), {"3.25in", "234"}, {"360pt", "360"}}) {
    const Outcome outcome = render(
        {map_, "--figure", "map", "--width", width, "--as", "svg", "--out", folder_ / "wide"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_NE(text_of("wide/map.svg").find("width=\"" + std::string(points)), std::string::npos)
        << width;
  }
  EXPECT_NE(render({map_, "--width", "8 feet"}).error.find("is not a length"), std::string::npos);
}

TEST_F(RenderOfAMap, RefusesPhrasesThatNoFigureHas) {
  const std::string style = folder_.file(
      "style.json",
      R"({"schema": {"name": "mapproof.style", "version": 1}, "words": {"estimat": "Karte"}})");
  const Outcome outcome = render({map_, "--style", style, "--out", folder_ / "o"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("no figure says \"estimat\"; did you mean \"estimate\"?"),
            std::string::npos)
      << outcome.error;
}

TEST_F(RenderOfAMap, SaysThatAMapDoesNotMove) {
  const Outcome outcome = render({map_, "--as", "gif"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("a map is one still figure"), std::string::npos) << outcome.error;
}

TEST_F(RenderOfAMap, TakesItsFileOrItsFolderOfFigures) {
  for (const std::string& input :
       {map_ + "/figures/map.figure.json", map_ + "/figures", map_ + "/map.json", map_}) {
    const Outcome outcome =
        render({input, "--width", "5", "--as", "svg", "--out", folder_ / "own"});
    EXPECT_EQ(outcome.exit_code, 0) << input << outcome.error;
    EXPECT_NE(text_of("own/map.svg").find("width=\"360"), std::string::npos) << input;
    fs::remove_all(folder_ / "own");
  }
}

TEST_F(RenderOfAMap, NamesLandmarksTitleAndWordsAsAsked) {
  ASSERT_EQ(render({map_, "--figure", "map", "--landmarks", "all", "--title", "Halle 3",
                    "--language", "de", "--as", "json", "--out", folder_ / "all"})
                .exit_code,
            0);
  const auto all = nlohmann::json::parse(text_of("all/map.figure.json"));
  EXPECT_EQ(all["title"], "Halle 3");
  EXPECT_NE(all.dump().find("\"Schätzung\""), std::string::npos);
  const auto named = [](const nlohmann::json& figure) {
    std::size_t count = 0;
    for (const auto& layer : figure["panels"][0]["layers"])
      if (layer["kind"] == "labels") count += layer["text"].size();
    return count;
  };
  const auto map = nlohmann::json::parse(read_file(map_ + "/map.json"));
  EXPECT_EQ(named(all), map["names"].size());
  ASSERT_EQ(render({map_, "--figure", "map", "--landmarks", "none", "--as", "json", "--out",
                    folder_ / "none"})
                .exit_code,
            0);
  EXPECT_EQ(named(nlohmann::json::parse(text_of("none/map.figure.json"))), 0U);
}

TEST_F(RenderOfAMap, PutsSeveralIntoOneFigure) {
  const Outcome outcome = render({"--panel", map_, map_ + "/figures/map.figure.json", "--as",
                                  "json,svg", "--out", folder_ / "both"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto figure = nlohmann::json::parse(text_of("both/panels.figure.json"));
  EXPECT_EQ(figure["panels"].size(), 2U);
  EXPECT_TRUE(figure["shared_x"].get<bool>());
  EXPECT_NE(figure["panels"][0]["title"], figure["panels"][1]["title"]);
}

TEST_F(RenderOfAMap, RefusesInOneLineWhatWouldChangeNothingOrIsNotThere) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{map_, "--as", "csv", "--width", "5"}, "--width: has no effect on csv"},
      {{map_, "--as", "csv", "--figure", "map", "--title", "X"}, "--title: has no effect on csv"},
      {{map_, "--as", "pdf", "--dpi", "300"}, "--dpi: only png has pixels"},
      {{map_, "--as", "mp4"}, "a map is one still figure"},
      {{map_, "--animate", "scene-x"}, "nothing moves"},
      {{map_, "--figure", "mop"}, "did you mean \"map\"?"},
      {{map_, "--landmarks", "nobody"}, "no landmark \"nobody\""},
      {{map_, "--font", map_ + "/map.json"}, "is not a TrueType or OpenType font"},
      {{map_, "--style", map_ + "/map.json"}, "map.json"},
      {{folder_ / ""}, "holds nothing to draw"},
      {{map_ + "/map.csv"}, "is not a figure"},
      {{folder_ / "none"}, "there is no such file or folder"},
      {{"--panel", map_, map_}, "name the folder for the figure by --out"},
      {{}, "name what to draw"}};
  for (const auto& [words, said] : wrong) {
    const Outcome outcome = render(words);
    EXPECT_EQ(outcome.exit_code, 2) << said;
    EXPECT_NE(outcome.error.find(said), std::string::npos) << outcome.error;
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  }
}

TEST_F(RenderOfAMap, WritesNothingWhereAnImageWouldBeTooLarge) {
  const std::string out = folder_ / "large";
  const Outcome outcome =
      render({map_, "--width", "20", "--dpi", "1200", "--as", "svg,png,json", "--out", out});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("an image has 1 to 20000 pixels along a side, not 24000 x "),
            std::string::npos)
      << outcome.error;
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(RenderOfAMap, ListsWhatCanBeDrawn) {
  const Outcome outcome = render({map_, "--list"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.out.starts_with("map  figure: ")) << outcome.out;
}

TEST_F(RenderOfAMap, AListTakesNoOptionsOfDrawing) {
  for (const char* option : {"--width=5", "--figure=map", "--as=png", "--title=Hall"}) {
    const Outcome outcome = render({map_, "--list", option});
    EXPECT_EQ(outcome.exit_code, 2) << option;
    EXPECT_NE(outcome.error.find("has no effect on --list"), std::string::npos) << outcome.error;
  }
}

TEST_F(RenderOfAMap, SaysWhichNamesFindNoRoom) {
  const std::string large = folder_.file(
      "style.json",
      R"({"schema": {"name": "mapproof.style", "version": 1}, "theme": "paper", "font_pt": 16})");
  const Outcome crowded = render({map_, "--figure", "map", "--style", large, "--width", "2",
                                  "--height", "1", "--landmarks", "all", "--as", "svg"});
  EXPECT_EQ(crowded.exit_code, 0) << crowded.error;
  EXPECT_NE(crowded.error.find("map: no room for the names of "), std::string::npos)
      << crowded.error;
  const Outcome wide =
      render({map_, "--figure", "map", "--landmarks", "L1,L2", "--width", "12", "--as", "svg"});
  EXPECT_EQ(wide.error.find("no room"), std::string::npos) << wide.error;
}

TEST_F(RenderOfAMap, NamesLandmarksWhoseErrorsAreNotKnown) {
  const std::string svg = text_of("map/figures/map.svg");
  for (const char* name : {"aria-label=\"L2\"", "aria-label=\"L30\""})
    EXPECT_NE(svg.find(name), std::string::npos) << name;
}

TEST_F(RenderOfAMap, ACaptionIsInOneLanguage) {
  const auto caption = [&](const std::string& language) {
    EXPECT_EQ(render({map_, "--figure", "map", "--language", language, "--as", "json", "--out",
                      folder_ / language})
                  .exit_code,
              0);
    return nlohmann::json::parse(text_of(language + "/map.figure.json"))
        .at("caption")
        .get<std::string>();
  };
  EXPECT_EQ(caption("de").find("LPCA, Peilung, 200 Schritte"), 0U) << caption("de");
  EXPECT_NE(caption("fr").find("carrés : positions données des ancres"), std::string::npos)
      << caption("fr");
  auto figure = nlohmann::json::parse(text_of("map/figures/map.figure.json"));
  figure["caption"] = "A phrase of nobody's dictionary: error of the map.";
  folder_.file("own.figure.json", figure.dump());
  ASSERT_EQ(render({folder_ / "own.figure.json", "--language", "de", "--as", "json", "--out",
                    folder_ / "own"})
                .exit_code,
            0);
  const auto own = nlohmann::json::parse(text_of("own/map.figure.json"));
  EXPECT_EQ(own.at("caption"), figure.at("caption"));
}

TEST_F(RenderOfAMap, ItsScriptLeavesTheFiguresPdfAsItIs) {
  ASSERT_EQ(render({map_, "--figure", "map", "--as", "pdf,matplotlib", "--out", folder_ / "both"})
                .exit_code,
            0);
  const std::string before = text_of("both/map.pdf");
  const Outcome drawn =
      run_program({"/bin/sh", "-c", "cd '" + (folder_ / "both").string() + "' && python3 map.py"});
  if (drawn.error.find("No module named") != std::string::npos) GTEST_SKIP() << drawn.error;
  EXPECT_EQ(drawn.exit_code, 0) << drawn.error;
  EXPECT_EQ(text_of("both/map.pdf"), before);
  EXPECT_TRUE(fs::exists(folder_ / "both/map-matplotlib.pdf"));
}

TEST_F(RenderOfAMap, ItsFolderTakesAnotherMapByForceAlone) {
  const std::string files = std::string(kExamples) + "/hall";
  std::vector<std::string> words = {
      "map", files + "/bearings.csv", "--sensor", "bearing", "--method", "isomap", "--out", map_};
  const Outcome refused = mapproof(words);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.error.find("--force"), std::string::npos) << refused.error;
  words.emplace_back("--force");
  EXPECT_EQ(mapproof(words).exit_code, 0);
}

TEST(RenderOfARangeMap, DrawsItsFiguresAgain) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      mapproof({"slam", std::string(kExamples) + "/drive", "--out", folder / "slam"}).exit_code, 0);
  const Outcome outcome =
      mapproof({"render", folder / "slam", "--theme", "paper", "--as", "pdf,svg"});
  // A column's width has room for every legend.
  for (const auto& entry : fs::directory_iterator(folder.path() / "slam/figures-paper"))
    if (entry.path().extension() == ".svg") {
      const std::string svg = read_file(entry.path());
      for (std::size_t at = svg.find("class=\"legend-text\""); at != std::string::npos;
           at = svg.find("class=\"legend-text\"", at + 1))
        EXPECT_EQ(svg.substr(at, svg.find("</g>", at) - at).find("\u2026"), std::string::npos)
            << entry.path();
    }
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_FALSE(fs::is_empty(folder.path() / "slam/figures-paper"));
}

}  // namespace
}  // namespace mapproof::test
