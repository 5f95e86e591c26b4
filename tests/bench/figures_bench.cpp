#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/figures/maps/map.hpp"
#include "render/output/write_figure.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace {

using namespace mapproof;
namespace fs = std::filesystem;

constexpr int kFigures = 100;

/// What the other programs are to draw as well: one line a number, plain for any reader.
void write_inputs(const fs::path& folder) {
  for (int i = 0; i < kFigures; ++i) {
    const MapRecord map = test::sample_map(50, 0.12, static_cast<std::uint64_t>(i) + 1);
    std::string text;
    for (Eigen::Index row = 0; row < map.estimate.rows(); ++row)
      text +=
          fmt::format("{} {} {} {} {}\n", map.names[row], (*map.ground_truth_m)(row, 0),
                      (*map.ground_truth_m)(row, 1), map.estimate(row, 0), map.estimate(row, 1));
    write_file(folder / fmt::format("map-{}.txt", i), text);
    text.clear();
    for (const ErrorLine& curve :
         test::sample_curves(4, static_cast<std::uint64_t>(i) + 1).curves) {
      for (std::size_t k = 0; k < curve.x.size(); ++k)
        text +=
            fmt::format("{} {} {} {}\n", curve.x[k], curve.mean[k], curve.low[k], curve.high[k]);
      text += "\n\n";
    }
    write_file(folder / fmt::format("curve-{}.txt", i), text);
  }
}

struct Result {
  double processor_s = 0.0;
  double mean_bytes = 0.0;
};

/// Draws and writes all figures on one thread; the records are made beforehand.
Result measure(const std::function<std::string(int)>& draw, const fs::path& folder,
               const std::string& ending) {
  fs::create_directories(folder);
  std::size_t bytes = 0;
  const std::clock_t start = std::clock();
  for (int i = 0; i < kFigures; ++i) {
    const std::string file = draw(i);
    bytes += file.size();
    write_file(folder / fmt::format("{}.{}", i, ending), file);
  }
  const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return {taken, static_cast<double>(bytes) / kFigures};
}

}  // namespace

/// Prints "WHAT PROGRAM PROCESSOR_SECONDS BYTES" a line: 100 figures each, 1200 x 900 pixels.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: figures_bench FOLDER\n", stderr);
    return 2;
  }
  const fs::path folder = argv[1];
  write_inputs(folder);
  std::vector<MapRecord> maps;
  std::vector<ErrorCurveSpec> curves;
  for (int i = 0; i < kFigures; ++i) {
    maps.push_back(test::sample_map(50, 0.12, static_cast<std::uint64_t>(i) + 1));
    curves.push_back(test::sample_curves(4, static_cast<std::uint64_t>(i) + 1));
  }
  const Theme theme = report_theme();
  const std::vector<std::tuple<std::string, std::string, std::function<std::string(int)>>> jobs = {
      {"map-png", "png", [&](int i) { return figure_png(map_figure(maps[i], "map"), theme); }},
      {"curve-png", "png", [&](int i) { return figure_png(error_curve_figure(curves[i]), theme); }},
      {"map-svg", "svg", [&](int i) { return figure_svg(map_figure(maps[i], "map"), theme); }}};
  for (const auto& [what, ending, draw] : jobs) {
    const Result result = measure(draw, folder / what, ending);
    fmt::print("{} mapproof {:.3f} {:.0f}\n", what, result.processor_s, result.mean_bytes);
  }
}
