#include "render/output/write_figure.hpp"

#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/export/figure_csv.hpp"
#include "render/export/figure_script.hpp"
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

std::string write_figure(const Figure& figure, const Theme& theme, const OutputFolder& folder,
                         const FileFormats& formats) {
  const Drawing drawing = lay_out(figure, theme);
  std::string svg;
  for (const FileFormat format : formats) {
    switch (format) {
      case FileFormat::kSvg:
        svg = to_svg(drawing);
        folder.write(figure.id + ".svg", svg);
        break;
      case FileFormat::kPng:
        write_drawn(folder, figure.id + ".png", [&] { return to_png(drawing); });
        break;
      case FileFormat::kPdf:
        write_drawn(folder, figure.id + ".pdf", [&] { return to_pdf(drawing); });
        break;
      case FileFormat::kEps:
        write_drawn(folder, figure.id + ".eps", [&] { return to_eps(drawing); });
        break;
      case FileFormat::kJson:
        folder.write(figure.id + ".figure.json", figure_to_json(figure));
        break;
      case FileFormat::kCsv:
        folder.write(figure.id + ".csv", figure_csv(figure));
        break;
      case FileFormat::kMatplotlib:
        folder.write(figure.id + ".py", figure_script(figure, theme));
        break;
    }
  }
  return svg;
}

}  // namespace mapproof
