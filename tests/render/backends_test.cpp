#include "render/cairo/cairo_backend.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <regex>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "render/figures/maps/map.hpp"
#include "render/image/png_read.hpp"
#include "render/output/write_figure.hpp"
#include "render/plot/figure_json.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

Figure usual_map() { return map_figure(sample_map(50, 0.12, 1), "map-usual"); }

/// A folder that is gone with the test.
class Backends : public ::testing::Test {
 protected:
  /// What a program prints; empty if it is not there.
  std::string output_of(const std::string& command) {
    const std::string file = (folder_ / "output.txt").string();
    if (std::system((command + " > '" + file + "' 2> /dev/null").c_str()) != 0) return {};
    return read_file(file);
  }

  TemporaryFolder folder_;
};

TEST_F(Backends, PngIsReadByLibpngWithItsTextsAndDensity) {
  const PngFile png = read_png(figure_png(usual_map(), report_theme()));
  EXPECT_EQ(png.image.width, 1200);
  EXPECT_EQ(png.image.height, 900);
  EXPECT_EQ(png.pixels_per_metre, 5669u);  // 144 dpi.
  EXPECT_FALSE(png.has_time);
  EXPECT_TRUE(std::regex_match(
      png.texts.at("Software"),
      std::regex(R"(mapproof \(Cairo [0-9.]+, FreeType [0-9.]+, HarfBuzz [0-9.]+\))")))
      << png.texts.at("Software");
  EXPECT_EQ(png.texts.at("mapproof:figure"), "map-usual");
  EXPECT_EQ(png.texts.at("mapproof:records"), usual_map().record_ids.front());
  EXPECT_EQ(png.texts.at("Title"), usual_map().title);
}

TEST_F(Backends, PaperPngHasThreeHundredDotsAnInch) {
  const PngFile png = read_png(figure_png(usual_map(), paper_theme(3.25)));
  EXPECT_EQ(png.image.width, 975);
  EXPECT_EQ(png.pixels_per_metre, 11811u);
}

TEST_F(Backends, PngKeepsHostileTextsReadable) {
  Figure figure = usual_map();
  figure.title = "a\u202Eb\x01\xFF<b>\u00E9";
  const PngFile png = read_png(figure_png(figure, report_theme()));
  EXPECT_EQ(png.texts.at("Title"), "a[U+202E]b[U+0001][xFF]<b>\u00E9");
}

TEST_F(Backends, PdfKeepsItsTextSelectable) {
  Figure figure = usual_map();
  figure.title = "Karte \u00FC \u2212 \u05E9\u05DC\u05D5\u05DD fi";
  write_file(folder_ / "map.pdf", figure_pdf(figure, report_theme()));
  const std::string text = output_of("pdftotext '" + (folder_ / "map.pdf").string() + "' -");
  if (text.empty()) GTEST_SKIP() << "pdftotext is not installed";
  for (const char* part : {"Karte \u00FC \u2212 ", "\u05E9\u05DC\u05D5\u05DD", "fi", "MPE 0.",
                           "x [m]", "true position", "anchor"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
}

TEST_F(Backends, PdfHasAFixedDateAndATitle) {
  write_file(folder_ / "map.pdf", figure_pdf(usual_map(), report_theme()));
  const std::string info = output_of("pdfinfo -rawdates '" + (folder_ / "map.pdf").string() + "'");
  if (info.empty()) GTEST_SKIP() << "pdfinfo is not installed";
  EXPECT_TRUE(std::regex_search(info, std::regex("CreationDate: +(D:)?20000101000000"))) << info;
  EXPECT_EQ(info.find("ModDate"), std::string::npos) << info;
  EXPECT_NE(info.find(usual_map().title), std::string::npos) << info;
}

/// A figure in each format.
using Images = std::array<std::string, 3>;

Images images_of(const Figure& figure) {
  return {figure_png(figure, report_theme()), figure_svg(figure, report_theme()),
          figure_pdf(figure, report_theme())};
}

/// Names the figure, its format and the first byte that differs; empty if none does.
std::string difference(const Figure& figure, const Images& a, const Images& b) {
  constexpr std::array kFormats = {"png", "svg", "pdf"};
  for (std::size_t i = 0; i < kFormats.size(); ++i) {
    if (a[i] == b[i]) continue;
    const auto at = std::ranges::mismatch(a[i], b[i]).in1 - a[i].begin();
    return fmt::format("{}.{}: {} and {} bytes, different from byte {}", figure.id, kFormats[i],
                       a[i].size(), b[i].size(), at);
  }
  return "";
}

TEST_F(Backends, TheImageIsTheSameForEveryThread) {
  const std::vector<Figure> figures = sample_figures();
  std::vector<Images> expected;
  for (const Figure& figure : figures) expected.push_back(images_of(figure));
  std::vector<Images> found(3 * figures.size());
  std::vector<std::jthread> threads;
  for (std::size_t t = 0; t < 3; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t k = 0; k < figures.size(); ++k) {
        const std::size_t i = (k + 7 * t) % figures.size();  // In another order in each thread.
        found[t * figures.size() + i] = images_of(figures[i]);
      }
    });
  threads.clear();
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(difference(figures[i % figures.size()], expected[i % figures.size()], found[i]), "");
}

TEST_F(Backends, FilesAreNamedByTheFigureAndHoldWhatTheBytesFunctionsGive) {
  const Figure figure = usual_map();
  const fs::path folder = folder_ / "figures";
  const std::string svg = write_figure(figure, report_theme(), folder);
  EXPECT_EQ(svg, figure_svg(figure, report_theme()));
  EXPECT_EQ(read_file(folder / "map-usual.svg"), svg);
  EXPECT_EQ(read_file(folder / "map-usual.png"), figure_png(figure, report_theme()));
  EXPECT_EQ(read_file(folder / "map-usual.pdf"), figure_pdf(figure, report_theme()));
  EXPECT_EQ(figure_from_json(read_file(folder / "map-usual.figure.json"), "x"), figure);
}

TEST_F(Backends, AnIdThatIsAPathNeverReachesTheDisk) {
  for (const std::string id : {"../up", "a/b", "", "A", "a b", "-a", "a\n", "..", "a."}) {
    Figure figure = usual_map();
    figure.id = id;
    EXPECT_THROW(write_figure(figure, report_theme(), folder_.path()), InvalidInput) << id;
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Backends, AFileInTheFoldersPlaceIsAnError) {
  write_file(folder_ / "file", "x");
  EXPECT_THROW(write_figure(usual_map(), report_theme(), folder_ / "file"), IoError);
}

TEST_F(Backends, TheImageOfAHugePageIsRefused) {
  Drawing drawing = lay_out(usual_map(), report_theme());
  drawing.dpi = 1e9;
  EXPECT_THROW(to_image(drawing), InvalidInput);
}

}  // namespace
}  // namespace mapproof::test
