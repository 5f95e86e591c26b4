// A report of COUNT maps of 50 landmarks each, and the same maps for other programs:
//   report_bench make FOLDER COUNT    figures as values and numbers: FOLDER/map-N.txt
//   report_bench report FOLDER COUNT  draws the maps and writes FOLDER/report.html and
//   figures/*.svg
// The second prints "COUNT DRAW_S PAGE_S BYTES".
#include <chrono>
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "render/figures/maps/map.hpp"
#include "render/plot/layout.hpp"
#include "render/svg/svg.hpp"
#include "reports/html/report_html.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLandmarks = 50;
constexpr double kError_m = 0.1;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::string id_of(int number) { return fmt::format("map-{}", number); }

MapRecord map_of(int number) {
  return sample_map(kLandmarks, kError_m, static_cast<std::uint64_t>(number + 1));
}

void make(const fs::path& folder, int count) {
  for (int i = 0; i < count; ++i) {
    const MapRecord map = map_of(i);
    std::string text;
    for (int row = 0; row < kLandmarks; ++row)
      text +=
          fmt::format("{} {} {} {} {}\n", map.names[row], (*map.ground_truth_m)(row, 0),
                      (*map.ground_truth_m)(row, 1), map.estimate(row, 0), map.estimate(row, 1));
    write_file(folder / (id_of(i) + ".txt"), text);
  }
}

void report(const fs::path& folder, int count) {
  const auto begin = std::chrono::steady_clock::now();
  std::map<std::string, std::string> drawings;
  Gallery gallery;
  for (int i = 0; i < count; ++i) {
    const Figure figure = map_figure(map_of(i), id_of(i));
    gallery.figures.push_back({figure.id, figure.title, figure.caption, figure.alt, {}});
    drawings[figure.id] = to_svg(lay_out(figure, report_theme()));
  }
  const double draw_s = seconds_since(begin);
  const auto written = std::chrono::steady_clock::now();
  const Report page{"Maps", "", {{"maps", "Maps", {std::move(gallery)}}}, ""};
  const std::string html =
      report_html(page, load_templates(), [&](const std::string& id) { return drawings.at(id); });
  write_file(folder / "report.html", html);
  fmt::print("{} {:.3f} {:.3f} {}\n", count, draw_s, seconds_since(written), html.size());
  for (const auto& [id, svg] : drawings) write_file(folder / "figures" / (id + ".svg"), svg);
}

}  // namespace
}  // namespace mapproof::test

int main(int count, char** arguments) {
  const std::string command = count == 4 ? arguments[1] : "";
  if (command != "make" && command != "report") {
    std::fputs("usage: report_bench make|report FOLDER COUNT\n", stderr);
    return 2;
  }
  try {
    const int figures = std::stoi(arguments[3]);
    if (command == "make")
      mapproof::test::make(arguments[2], figures);
    else
      mapproof::test::report(arguments[2], figures);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
