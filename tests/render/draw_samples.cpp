#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "core/base/files.hpp"
#include "render/output/write_figure.hpp"
#include "tests/support/sample_figures.hpp"

/// Draws the sample figures whose ids begin with PREFIX into a folder, in every theme, for people
/// to look at.
int main(int argc, char** argv) {
  using namespace mapproof;
  if (argc != 2 && argc != 3) {
    std::fputs("usage: draw_samples FOLDER [PREFIX]\n", stderr);
    return 2;
  }
  for (const Figure& figure : test::sample_figures()) {
    if (argc == 3 && !figure.id.starts_with(argv[2])) continue;
    for (const auto& [folder, theme] : {std::pair{"report", report_theme()},
                                        {"single", paper_theme(3.25)},
                                        {"double", paper_theme(6.75)}})
      write_figure(figure, theme, std::filesystem::path(argv[1]) / folder);
  }
}
