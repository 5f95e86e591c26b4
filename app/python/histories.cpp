#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "app/python/bindings.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/observations.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof::python {
namespace {

namespace py = pybind11;

void require_size(const ObservationHistory& history) {
  const std::set<std::string> different(history.names.begin(), history.names.end());
  if (different.size() != history.names.size()) throw InvalidInput("names: two are the same");
  if (static_cast<Eigen::Index>(history.names.size()) != history.values.rows())
    throw InvalidInput(fmt::format("values: {} rows for {} names", history.values.rows(),
                                   history.names.size()));
  if (history.values.size() == 0) throw InvalidInput("values: there are none");
}

bool is_value_of(Sensor sensor, double value) {
  if (std::isnan(value)) return true;
  if (sensor == Sensor::kVisibility) return value == 0.0 || value == 1.0;
  return std::isfinite(value) && (sensor == Sensor::kBearing || value >= 0.0);
}

ObservationHistory make_history(const std::string& sensor, const std::vector<std::string>& names,
                                const Eigen::MatrixXd& values) {
  ObservationHistory history{.sensor = sensor_of(sensor), .names = names, .values = values};
  require_size(history);
  for (Eigen::Index column = 0; column < values.cols(); ++column)
    for (Eigen::Index row = 0; row < values.rows(); ++row)
      if (!is_value_of(history.sensor, values(row, column)))
        throw InvalidInput(
            fmt::format("values[{}, {}]: {} is not a {}: visibility is 0 or 1, bearings are in "
                        "rad, ranges in m and not negative, NaN is missing",
                        row, column, values(row, column), sensor));
  return history;
}

struct Simulation {
  ObservationHistory history;
  World world;
  Path path;
};

struct SimulationOptions {
  WorldOptions world;
  SensorOptions sensor;
  int steps = 2000;
  std::uint64_t seed = 1;
};

Simulation simulate(const SimulationOptions& options) {
  if (options.steps < 1) throw InvalidInput("steps: at least 1");
  if (options.world.landmarks < 1) throw InvalidInput("landmarks: at least 1");
  if (!(options.sensor.noise >= 0.0)) throw InvalidInput("noise: not negative");
  if (!(options.sensor.dropout_share >= 0.0 && options.sensor.dropout_share <= 1.0))
    throw InvalidInput("dropout_share: 0 to 1");
  if (!(options.world.side_m > 0.0 && std::isfinite(options.world.side_m)))
    throw InvalidInput("side_m: positive");
  Random random(options.seed);
  Simulation made;
  made.world = scatter_landmarks(options.world, random);
  made.path = random_walk(made.world, {}, options.steps, random);
  made.history = observe(made.world, made.path, options.sensor, random);
  return made;
}

Simulation simulate_words(const std::string& sensor, std::uint64_t seed, int landmarks, int steps,
                          const py::kwargs& more) {
  SimulationOptions options;
  options.world.landmarks = landmarks;
  options.steps = steps;
  options.seed = seed;
  options.sensor.sensor = sensor_of(sensor);
  for (const auto& [key, value] : more) {
    const auto name = key.cast<std::string>();
    if (name == "noise")
      options.sensor.noise = value.cast<double>();
    else if (name == "dropout_share")
      options.sensor.dropout_share = value.cast<double>();
    else if (name == "side_m")
      options.world.side_m = value.cast<double>();
    else
      throw py::type_error(fmt::format("simulate: no argument {}", name));
  }
  py::gil_scoped_release release;
  return simulate(options);
}

std::map<std::string, std::pair<double, double>> read_positions(const std::filesystem::path& path) {
  const NamedPoints read = read_landmarks(path);
  std::map<std::string, std::pair<double, double>> positions;
  for (std::size_t i = 0; i < read.names.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    positions[read.names[i]] = {read.positions_m(row, 0), read.positions_m(row, 1)};
  }
  return positions;
}

Eigen::Index steps_of(const ObservationHistory& history, std::optional<Eigen::Index> steps) {
  return steps.value_or(history.steps());
}

Eigen::MatrixXd distances(const ObservationHistory& history, std::optional<Eigen::Index> steps) {
  return proximities(history, steps_of(history, steps)).squared_distances.cwiseSqrt();
}

Eigen::MatrixXd feature_rows(const ObservationHistory& history,
                             std::optional<Eigen::Index> steps) {
  return features(history, steps_of(history, steps)).values;
}

void define_simulation(py::module_& module) {
  py::class_<Simulation>(module, "Simulation", "A simulated room, a walk and what was observed.")
      .def_readonly("history", &Simulation::history)
      .def_property_readonly("landmarks_m", [](const Simulation& s) { return s.world.landmarks_m; })
      .def_property_readonly("positions_m", [](const Simulation& s) { return s.path.positions_m; })
      .def_property_readonly("headings_rad",
                             [](const Simulation& s) { return s.path.headings_rad; });
  module.def("simulate", &simulate_words, py::arg("sensor"), py::kw_only(), py::arg("seed") = 1,
             py::arg("landmarks") = 50, py::arg("steps") = 2000,
             "A random room and walk [yairi2007, section 4.1]; also noise, dropout_share, side_m.");
}

}  // namespace

Sensor sensor_of(const std::string& name) {
  if (const std::optional<Sensor> sensor = sensor_named(name)) return *sensor;
  throw InvalidInput(
      fmt::format("sensor: visibility, bearing or range, not {}", printable(name)));
}

void define_histories(py::module_& module) {
  py::class_<ObservationHistory>(module, "ObservationHistory",
                                 "What one sensor observed of M landmarks over N steps.")
      .def(py::init(&make_history), py::arg("sensor"), py::arg("names"), py::arg("values"))
      .def_property_readonly(
          "sensor", [](const ObservationHistory& h) { return std::string(name(h.sensor)); })
      .def_readonly("names", &ObservationHistory::names)
      .def_readonly("values", &ObservationHistory::values, "M x N: 0 or 1, rad, or m; NaN: missing")
      .def_property_readonly("landmarks", &ObservationHistory::landmarks)
      .def_property_readonly("steps", &ObservationHistory::steps);
  module.def(
      "read_observations",
      [](const std::filesystem::path& path, const std::optional<std::string>& sensor) {
        std::optional<Sensor> kind;
        if (sensor) kind = sensor_of(*sensor);
        return read_observations(path, kind).history;
      },
      py::arg("path"), py::arg("sensor") = py::none(),
      "Reads any table of observations that `mapproof map` reads.");
  module.def("read_positions", &read_positions, py::arg("path"),
             "Reads name, x, y: anchors or a ground truth, in metres.");
  module.def("features", &feature_rows, py::arg("history"), py::arg("steps") = py::none(),
             py::call_guard<py::gil_scoped_release>(),
             "M x C: the vectors whose distances the methods keep, 0 where missing; of visibility "
             "the 0/1 entries, which distances() divides by their norm.");
  module.def("distances", &distances, py::arg("history"), py::arg("steps") = py::none(),
             py::call_guard<py::gil_scoped_release>(),
             "M x M: Euclidean distances of the features, those of visibility divided by their "
             "norm, over the steps that both landmarks have; inf: no common step.");
  define_simulation(module);
}

}  // namespace mapproof::python
