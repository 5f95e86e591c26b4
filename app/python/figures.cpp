#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "app/python/bindings.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "render/export/figure_csv.hpp"
#include "render/output/write_figure.hpp"
#include "render/plot/figure_json.hpp"
#include "render/theme/theme.hpp"

namespace mapproof::python {
namespace {

namespace py = pybind11;

Theme theme_of(const std::string& name, double width_in) {
  if (name == "report") return report_theme();
  if (name == "dark") return dark_theme();
  if (name == "paper") return paper_theme(width_in);
  throw InvalidInput(fmt::format("theme: report, dark or paper, not {}", printable(name)));
}

Figure read_figure(const std::filesystem::path& path) {
  return figure_from_json(read_file(path), path.string());
}

constexpr double kSingleColumn_in = 3.25;

}  // namespace

void define_figures(py::module_& module) {
  const auto theme = py::arg("theme") = "report";
  const auto width = py::arg("width_in") = kSingleColumn_in;
  py::class_<Figure>(module, "Figure", "A figure as a value: drawn as SVG, PNG or PDF.")
      .def_readonly("id", &Figure::id)
      .def_readonly("title", &Figure::title)
      .def_readonly("caption", &Figure::caption)
      .def_readonly("alt", &Figure::alt, "What it shows, in words with numbers.")
      .def(
          "svg",
          [](const Figure& figure, const std::string& name, double width_in) {
            return figure_svg(figure, theme_of(name, width_in));
          },
          theme, width, "The text of an SVG file; width_in: of the theme paper.")
      .def(
          "png",
          [](const Figure& figure, const std::string& name, double width_in) {
            return py::bytes(figure_png(figure, theme_of(name, width_in)));
          },
          theme, width)
      .def(
          "pdf",
          [](const Figure& figure, const std::string& name, double width_in) {
            return py::bytes(figure_pdf(figure, theme_of(name, width_in)));
          },
          theme, width)
      .def("json", &figure_to_json, "What ID.figure.json holds.")
      .def("csv", &figure_csv, "The data behind it, one row per mark.")
      .def(
          "write",
          [](const Figure& figure, const std::filesystem::path& folder, const std::string& name,
             double width_in) {
            write_figure(figure, theme_of(name, width_in), OutputFolder(folder));
          },
          py::arg("folder"), theme, width, "Writes ID.svg, ID.png, ID.pdf and ID.figure.json.")
      .def("_repr_svg_",
           [](const Figure& figure) { return figure_svg(figure, report_theme()); });
  module.def("read_figure", &read_figure, py::arg("path"), "Reads ID.figure.json.");
}

}  // namespace mapproof::python
