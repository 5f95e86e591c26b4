#include "render/output/write_figure.hpp"

#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/output/write_drawn.hpp"
#include "render/plot/figure_json.hpp"
#include "render/plot/layout.hpp"
#include "render/svg/svg.hpp"

namespace mapproof {

std::string figure_svg(const Figure& figure, const Theme& theme) {
  return to_svg(lay_out(figure, theme));
}

std::string figure_png(const Figure& figure, const Theme& theme) {
  return to_png(lay_out(figure, theme));
}

std::string figure_pdf(const Figure& figure, const Theme& theme) {
  return to_pdf(lay_out(figure, theme));
}

std::string write_figure(const Figure& figure, const Theme& theme, const OutputFolder& folder) {
  const Drawing drawing = lay_out(figure, theme);
  std::string svg = to_svg(drawing);
  folder.write(figure.id + ".svg", svg);
  write_drawn(folder, figure.id + ".png", [&] { return to_png(drawing); });
  write_drawn(folder, figure.id + ".pdf", [&] { return to_pdf(drawing); });
  folder.write(figure.id + ".figure.json", figure_to_json(figure));
  return svg;
}

}  // namespace mapproof
