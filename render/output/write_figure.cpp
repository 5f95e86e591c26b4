#include "render/output/write_figure.hpp"

#include "core/base/files.hpp"
#include "render/cairo/cairo_backend.hpp"
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

FigureFiles write_figure(const Figure& figure, const Theme& theme,
                         const std::filesystem::path& folder) {
  const Drawing drawing = lay_out(figure, theme);
  const FigureFiles files{folder / (figure.id + ".svg"), folder / (figure.id + ".png"),
                          folder / (figure.id + ".pdf"), folder / (figure.id + ".figure.json")};
  write_file(files.svg, to_svg(drawing));
  write_file(files.png, to_png(drawing));
  write_file(files.pdf, to_pdf(drawing));
  write_file(files.json, figure_to_json(figure));
  return files;
}

}  // namespace mapproof
