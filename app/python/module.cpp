#include <pybind11/pybind11.h>

#include "app/python/bindings.hpp"
#include "core/base/errors.hpp"
#include "core/base/version.hpp"

namespace mapproof::python {

PYBIND11_MODULE(_core, module) {
  // InvalidInput is a std::invalid_argument, which pybind11 makes a ValueError of.
  pybind11::register_exception<IoError>(module, "IoError", PyExc_OSError);
  define_histories(module);
  define_figures(module);
  define_maps(module);
  define_studies(module);
  module.attr("__version__") = std::string(version());
}

}  // namespace mapproof::python
