#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
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
  double seconds = 0.0;
  double mean_bytes = 0.0;
};

/// Draws and writes all figures with so many threads; the records are made beforehand.
Result measure(const std::function<std::string(int)>& draw, const fs::path& folder,
               const std::string& ending, int threads) {
  fs::create_directories(folder);
  std::vector<std::size_t> bytes(kFigures);
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::jthread> workers;
  for (int t = 0; t < threads; ++t)
    workers.emplace_back([&, t] {
      for (int i = t; i < kFigures; i += threads) {
        const std::string file = draw(i);
        bytes[i] = file.size();
        write_file(folder / fmt::format("{}.{}", i, ending), file);
      }
    });
  workers.clear();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  double sum = 0.0;
  for (const std::size_t size : bytes) sum += static_cast<double>(size);
  return {taken.count(), sum / kFigures};
}

}  // namespace

/// Prints "WHAT PROGRAM SECONDS BYTES" a line: 100 figures each, 1200 x 900 pixels.
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
  for (const int threads : {1, 2})
    for (const auto& [what, ending, draw] : jobs) {
      const std::string program = threads == 1 ? "mapproof" : "mapproof-2-threads";
      const Result result = measure(draw, folder / what, ending, threads);
      fmt::print("{} {} {:.3f} {:.0f}\n", what, program, result.seconds, result.mean_bytes);
    }
}
