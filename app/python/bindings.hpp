#pragma once

#include <optional>
#include <string>

#include <pybind11/pybind11.h>

#include "core/model/experiment.hpp"
#include "core/model/method.hpp"
#include "core/model/sensor.hpp"

namespace mapproof::python {

// What the module holds, by histories.cpp, figures.cpp, maps.cpp and studies.cpp; each may return
// what those before it define.
void define_histories(pybind11::module_& module);
void define_figures(pybind11::module_& module);
void define_maps(pybind11::module_& module);
void define_studies(pybind11::module_& module);

// Words of Python as values of core, by histories.cpp and maps.cpp.

/// @throws InvalidInput naming those that there are.
Sensor sensor_of(const std::string& name);
AffineFit affine_fit_of(const std::string& name);

/// @param parameter  Empty: to be chosen, or the method has none.
/// @throws InvalidInput if there is no such method, or its parameter cannot have the value.
MethodSetting setting_of(const std::string& method, std::optional<double> parameter);

}  // namespace mapproof::python
