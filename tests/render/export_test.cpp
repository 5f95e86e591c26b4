#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/child_process.hpp"
#include "core/base/files/files.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/export/figure_csv.hpp"
#include "render/export/figure_script.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/samples/sample_scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

TEST(FigureCsv, HasEveryPointWithItsLayerAndLandmark) {
  Figure figure;
  figure.id = "f";
  figure.panels.resize(1);
  figure.panels[0].layers.emplace_back(
      Scatter{.label = "estimate",
              .x = {1.5, 2.0},
              .y = {0.25, -1.0},
              .marks = {{"a", {{"landmark", "door, left"}}}, {"b", {{"landmark", "desk"}}}}});
  figure.panels[0].layers.emplace_back(Segments{.x0 = {0}, .y0 = {0}, .x1 = {1}, .y1 = {2}});
  EXPECT_EQ(figure_csv(figure),
            "panel,layer,shape,label,index,landmark,x,y,x_end,y_end\n"
            "1,1,point,estimate,1,\"door, left\",1.5,0.25,,\n"
            "1,1,point,estimate,2,desk,2,-1,,\n"
            "1,2,segment,,1,,0,0,1,2\n");
}

TEST(FigureCsv, GivesCellsTheirMiddleFromTheUppermostRowOn) {
  Figure figure;
  figure.id = "f";
  figure.panels.resize(1);
  figure.panels[0].layers.emplace_back(Cells{.x = {0, 2},
                                             .y = {0, 4},
                                             .columns = 2,
                                             .values = {1, 2, 3, 4},
                                             .colour_scale = {.limits = {0, 4}}});
  EXPECT_EQ(figure_csv(figure),
            "panel,layer,shape,index,x,y,value\n1,1,cell,1,0.5,3,1\n1,1,cell,2,1.5,3,2\n"
            "1,1,cell,3,0.5,1,3\n1,1,cell,4,1.5,1,4\n");
}

TEST(FigureCsv, GivesTheValueOfEachPointOfAColouredLine) {
  Figure figure;
  figure.id = "f";
  figure.panels.resize(1);
  figure.panels[0].layers.emplace_back(Polyline{
      .x = {0, 1}, .y = {2, 3}, .values = {0.5, 0.25}, .colour_scale = {.limits = {0, 1}}});
  EXPECT_EQ(figure_csv(figure),
            "panel,layer,shape,index,x,y,value\n1,1,line,1,0,2,0.5\n1,1,line,2,1,3,0.25\n");
}

TEST(FigureCsv, HasRowsForEverySample) {
  for (const Figure& figure : sample_figures()) {
    const bool is_empty_figure = std::ranges::all_of(figure.panels, [](const Panel& panel) {
      return std::ranges::all_of(panel.layers, is_empty);
    });
    EXPECT_EQ(lines_of(figure_csv(figure)) > 1, !is_empty_figure) << figure.id;
  }
  for (const Scene& scene : sample_scenes()) EXPECT_GT(lines_of(scene_csv(scene)), 1U) << scene.id;
}

/// Debian's, which its package of matplotlib is for.
constexpr const char* kPython = "/usr/bin/python3";

bool has_matplotlib() {
  return fs::exists(kPython) &&
         ChildProcess({kPython, {"-c", "import matplotlib, mpl_toolkits.mplot3d"}}, {})
             .wait()
             .is_success();
}

/// Runs all scripts in one interpreter: its start takes longer than most figures.
constexpr const char* kRunner =
    "import runpy, sys, pathlib\n"
    "import matplotlib\n"
    "matplotlib.use('Agg')\n"
    "import matplotlib.pyplot as plt\n"
    "for script in sorted(pathlib.Path(sys.argv[1]).glob('*.py')):\n"
    "    sys.argv = [str(script), str(script.with_suffix('.png'))]\n"
    "    plt.rcParams['savefig.dpi'] = 40\n"
    "    try:\n"
    "        runpy.run_path(str(script), run_name='__main__')\n"
    "    except Exception as error:\n"
    "        sys.exit(f'{script.stem}: {error}')\n"
    "    plt.close('all')\n";

TEST(FigureScript, DrawsEveryTypeOfFigureAndSceneByMatplotlib) {
  const TemporaryFolder folder;
  Theme theme = report_theme();
  theme.dpi = 40.0;
  std::vector<std::string> ids;
  for (const Figure& figure : sample_figures()) {
    const std::string script = figure_script(figure, theme);
    // One call a layer at least, and every panel.
    for (std::size_t p = 1; p <= figure.panels.size(); ++p)
      EXPECT_NE(script.find(fmt::format("# Panel {}\n", p)), std::string::npos) << figure.id;
    if (lines_of(script) > 20'000) continue;  // The largest samples add nothing but time.
    write_file(folder.path() / (figure.id + ".py"), script);
    ids.push_back(figure.id);
  }
  for (const Scene& scene : sample_scenes()) {
    write_file(folder.path() / (scene.id + ".py"), scene_script(scene, theme));
    ids.push_back(scene.id);
  }
  if (!has_matplotlib()) GTEST_SKIP() << "python3-matplotlib is not installed: not run";
  const fs::path runner = folder.path() / "run";
  write_file(runner, kRunner);
  EXPECT_TRUE(
      ChildProcess({kPython, {runner.string(), folder.path().string()}}, {}).wait().is_success());
  for (const std::string& id : ids) EXPECT_TRUE(fs::exists(folder.path() / (id + ".png"))) << id;
}

TEST(Eps, IsTheSameEachTimeAndHasOnePageOfTheSizeOfTheFigure) {
  const Drawing drawing = lay_out(sample_figures().front(), paper_theme(3.25));
  const std::string eps = to_eps(drawing);
  EXPECT_TRUE(eps.starts_with("%!PS-Adobe-3.0 EPSF-3.0"));
  EXPECT_NE(eps.find("%%BoundingBox: "), std::string::npos);
  EXPECT_EQ(eps.find("CreationDate"), std::string::npos);
  EXPECT_EQ(eps, to_eps(drawing));
}

}  // namespace
}  // namespace mapproof::test
