#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "app/python/bindings.hpp"
#include "core/base/not_finite.hpp"
#include "core/records/studies/study_contents.hpp"
#include "core/results/quantity.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof::python {
namespace {

namespace py = pybind11;

StudyContents read_contents(const std::filesystem::path& folder, bool maps) {
  ContentsAsked asked{.seconds = true};
  if (maps) asked.maps = [](const std::filesystem::path&) { return true; };
  return read_study_contents(folder, asked);
}

/// A column of levels, None where a row's condition does not have that factor.
py::list level_column(const std::vector<Result>& rows, const std::string& factor) {
  py::list column;
  for (const Result& row : rows) {
    py::object value = py::none();
    for (const Level& level : row.at.levels)
      if (level.factor == factor)
        value = std::visit([](const auto& of) -> py::object { return py::cast(of); }, level.value);
    column.append(value);
  }
  return column;
}

/// The columns of results.csv by their names, in its order.
py::dict columns_of(const std::vector<Result>& rows) {
  const auto texts = [&](Name Result::*member) {
    py::list column;
    for (const Result& row : rows) column.append((row.*member).get());
    return column;
  };
  py::list setups;
  std::map<std::string, bool> factors;
  py::array_t<double> values(static_cast<py::ssize_t>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    setups.append(rows[i].at.setup.get());
    values.mutable_at(static_cast<py::ssize_t>(i)) = rows[i].value;
    for (const Level& level : rows[i].at.levels) factors[level.factor] = true;
  }
  py::dict columns;
  columns["setup"] = setups;
  columns["method"] = texts(&Result::method);
  columns["quantity"] = texts(&Result::quantity);
  columns["run"] = texts(&Result::run);
  columns["group"] = texts(&Result::group);
  columns["subject"] = texts(&Result::subject);
  columns["value"] = values;
  for (const auto& [factor, there] : factors)
    columns[py::str("at." + factor)] = level_column(rows, factor);
  return columns;
}

py::dict quantity_columns(const StudyContents& study) {
  py::list ids, labels, units, better;
  for (const Quantity& quantity : study.results.quantities.all()) {
    const auto is_it = [&](const Result& row) { return row.quantity == quantity.id; };
    if (std::ranges::none_of(study.results.rows, is_it)) continue;
    ids.append(quantity.id);
    labels.append(quantity.label);
    units.append(quantity.unit);
    better.append(std::string(name(quantity.better)));
  }
  py::dict columns;
  columns["quantity"] = ids;
  columns["label"] = labels;
  columns["unit"] = units;
  columns["better"] = better;
  return columns;
}

py::dict outcome_columns(const StudyContents& study) {
  py::list setups, methods, runs, codes;
  for (const RunOutcome& outcome : study.results.outcomes) {
    setups.append(outcome.at.setup.get());
    methods.append(outcome.method.get());
    runs.append(outcome.run.get());
    codes.append(outcome.codes);
  }
  py::dict columns;
  columns["setup"] = setups;
  columns["method"] = methods;
  columns["run"] = runs;
  columns["codes"] = codes;
  return columns;
}

/// Maps and paths by name: names, positions and the ground truth.
py::dict points_of(const StudyContents& study) {
  py::dict all;
  for (const auto& [id, points] : study.points)
    all[py::str(id)] = py::make_tuple(points.names, points.points, points.ground_truth);
  return all;
}

}  // namespace

void define_studies(py::module_& module) {
  py::class_<StudyContents>(module, "StudyContents")
      .def_readonly("kind", &StudyContents::kind)
      .def_property_readonly("results",
                             [](const StudyContents& s) { return columns_of(s.results.rows); })
      .def_property_readonly("seconds",
                             [](const StudyContents& s) { return columns_of(s.seconds); })
      .def_property_readonly("quantities", &quantity_columns)
      .def_property_readonly("outcomes", &outcome_columns)
      .def_property_readonly("points", &points_of);
  module.def("read_study", &read_contents, py::arg("folder"), py::arg("maps") = false,
             py::call_guard<py::gil_scoped_release>());
}

}  // namespace mapproof::python
