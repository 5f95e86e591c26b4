#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "app/map/stop_rules.hpp"
#include "app/python/bindings.hpp"
#include "core/align/affine.hpp"
#include "core/align/aligned_to.hpp"
#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/embed/embedder.hpp"
#include "core/model/map_record.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/score/map_score.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/status_text.hpp"
#include "render/output/write_figure.hpp"

namespace mapproof::python {
namespace {

namespace py = pybind11;

using Positions = std::map<std::string, std::pair<double, double>>;

Embedding embed(const ObservationHistory& history, const std::string& method,
                std::optional<double> parameter, std::optional<Eigen::Index> steps) {
  MethodSetting setting = setting_of(method, parameter);
  return embed_history(history, steps.value_or(history.steps()), setting, options_for_users());
}

/// The proximities of points with these distances: inner products by double centring.
Proximities proximities_of(const Eigen::MatrixXd& distances) {
  if (distances.rows() != distances.cols()) throw InvalidInput("distances: not square");
  if (!distances.allFinite() || (distances.array() < 0.0).any())
    throw InvalidInput("distances: finite and not negative");
  if (distances != distances.transpose()) throw InvalidInput("distances: not symmetric");
  if ((distances.diagonal().array() != 0.0).any())
    throw InvalidInput("distances: the diagonal is not zero");
  Proximities of;
  of.squared_distances = distances.cwiseAbs2();
  const Eigen::RowVectorXd means = of.squared_distances.colwise().mean();
  of.inner_products = of.squared_distances.rowwise() - means;
  of.inner_products.colwise() -= means.transpose();
  of.inner_products.array() += means.mean();
  of.inner_products *= -0.5;
  return of;
}

Embedding embed_distances(const Eigen::MatrixXd& distances, const std::string& method,
                          std::optional<double> parameter) {
  MethodSetting setting = setting_of(method, parameter);
  Embedder embedder(proximities_of(distances), options_for_users());
  if (!parameter) setting = embedder.usual_setting(setting.method);
  return embedder.embed(setting);
}

/// The rows of the landmarks that have a position there. @throws InvalidInput for unknown names.
std::vector<Eigen::Index> rows_of(const Positions& positions, const std::vector<std::string>& names,
                                  const char* argument) {
  std::map<std::string, Eigen::Index> rows;
  for (std::size_t i = 0; i < names.size(); ++i) rows[names[i]] = static_cast<Eigen::Index>(i);
  std::vector<Eigen::Index> found;
  for (const auto& [landmark, position] : positions) {
    if (!rows.contains(landmark))
      throw InvalidInput(fmt::format("{}: no landmark {}", argument, printable(landmark)));
    if (!std::isfinite(position.first) || !std::isfinite(position.second))
      throw InvalidInput(fmt::format("{}: {} is not finite", argument, printable(landmark)));
    found.push_back(rows.at(landmark));
  }
  std::sort(found.begin(), found.end());
  return found;
}

Points points_of(const Positions& positions, const std::vector<std::string>& names) {
  Points points = Points::Constant(static_cast<Eigen::Index>(names.size()), 2, kNaN);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto found = positions.find(names[i]); found != positions.end())
      points.row(static_cast<Eigen::Index>(i)) << found->second.first, found->second.second;
  return points;
}

/// What a map is compared with, and tied to.
struct MapPositions {
  Positions anchors, ground_truth;
};

MapRecord make_map(const ObservationHistory& history, const MethodSetting& setting,
                   const MapPositions& known) {
  HistoryEmbedder embedder(history, history.steps(), options_for_users());
  const Embedding embedding = embedder.embed(setting);
  MapRecord map;
  map.id = "map";
  map.origin = FromSensor{history.sensor, setting};
  map.step = static_cast<int>(history.steps());
  map.names = history.names;
  map.anchors = rows_of(known.anchors, map.names, "anchors");
  rows_of(known.ground_truth, map.names, "ground_truth");
  map.statuses = embedding.statuses;
  AlignedMap aligned;
  aligned.positions_m = embedding.coordinates;
  if (!map.anchors.empty())
    aligned = align_to_anchors(embedding.coordinates, points_of(known.anchors, map.names),
                               map.anchors, AffineFit::kLeastDistances);
  map.statuses.insert(map.statuses.end(), aligned.statuses.begin(), aligned.statuses.end());
  map.estimate = aligned.positions_m;
  map.frame = aligned.aligned ? Frame::kGroundTruth : Frame::kSimilarity;
  Positions surveyed = known.ground_truth;
  surveyed.insert(known.anchors.begin(), known.anchors.end());
  if (!surveyed.empty()) map.ground_truth_m = points_of(surveyed, map.names);
  if (aligned.aligned && !known.ground_truth.empty())
    map.score =
        score_map(map.estimate, *map.ground_truth_m, map.anchors, AffineFit::kLeastDistances);
  return map;
}

MapRecord map_observations(const ObservationHistory& history, const std::string& method,
                           std::optional<double> parameter, const Positions& anchors,
                           const Positions& ground_truth) {
  MethodSetting setting = setting_of(method, parameter);
  if (!parameter) setting = HistoryEmbedder(history, history.steps()).usual_setting(setting.method);
  return make_map(history, setting, {anchors, ground_truth});
}

Similarity similarity(const Points& from, const Points& to, const std::string& alignment) {
  for (const Alignment known : {Alignment::kNone, Alignment::kRigid,
                                Alignment::kRigidWithReflection, Alignment::kSimilarity})
    if (name(known) == alignment) return fit_similarity(from, to, known);
  throw InvalidInput(fmt::format(
      "alignment: none, rigid, rigid-with-reflection or similarity, not {}", printable(alignment)));
}

void define_methods(py::module_& module) {
  py::class_<ParameterInfo>(module, "ParameterInfo", "The one number a method is tuned by.")
      .def_readonly("symbol", &ParameterInfo::symbol)
      .def_readonly("meaning", &ParameterInfo::meaning)
      .def_readonly("integer", &ParameterInfo::integer)
      .def_readonly("minimum", &ParameterInfo::minimum)
      .def_readonly("maximum", &ParameterInfo::maximum);
  py::class_<MethodInfo>(module, "MethodInfo", "A mapping method.")
      .def_readonly("name", &MethodInfo::name)
      .def_readonly("label", &MethodInfo::label)
      .def_readonly("summary", &MethodInfo::summary)
      .def_readonly("source", &MethodInfo::source)
      .def_readonly("parameter", &MethodInfo::parameter);
  module.def(
      "methods", [] { return std::vector<MethodInfo>(all_methods().begin(), all_methods().end()); },
      "The mapping methods, in the order of the paper's tables.");
}

void define_embeddings(py::module_& module) {
  py::class_<Status>(module, "Status", "Why a solve ended with a warning or failed.")
      .def_property_readonly("code", [](const Status& s) { return std::string(name(s.code)); })
      .def_property_readonly("reason", [](const Status& s) { return std::string(name(s.reason)); })
      .def_readonly("names", &Status::names)
      .def("__str__", &status_text)
      .def("__repr__", [](const Status& s) {
        return fmt::format("<Status {}: {}>", name(s.code), status_text(s));
      });
  py::class_<Embedding>(module, "Embedding", "Coordinates before any alignment.")
      .def_readonly("coordinates", &Embedding::coordinates, "M x 2; NaN rows: not mapped")
      .def_readonly("statuses", &Embedding::statuses)
      .def_readonly("spectrum", &Embedding::spectrum)
      .def_readonly("iterations", &Embedding::iterations)
      .def_readonly("stress", &Embedding::stress);
  module.def("embed", &embed, py::arg("history"), py::arg("method"),
             py::arg("parameter") = py::none(), py::arg("steps") = py::none(),
             py::call_guard<py::gil_scoped_release>(), "Maps a history by a method.");
  module.def("embed_distances", &embed_distances, py::arg("distances"), py::arg("method"),
             py::arg("parameter") = py::none(), py::call_guard<py::gil_scoped_release>(),
             "Maps by an M x M matrix of distances.");
}

void define_alignment(py::module_& module) {
  py::class_<Affine>(module, "Affine", "points @ linear + offset")
      .def_readonly("linear", &Affine::linear)
      .def_readonly("offset", &Affine::offset)
      .def("__call__", &Affine::operator(), py::arg("points"));
  py::class_<Similarity>(module, "Similarity", "scale * points @ rotation.T + offset")
      .def_readonly("scale", &Similarity::scale)
      .def_readonly("rotation", &Similarity::rotation)
      .def_readonly("offset", &Similarity::offset)
      .def("__call__", &Similarity::operator(), py::arg("points"));
  const auto fit = py::arg("fit") = "least_distances";
  module.def(
      "fit_affine",
      [](const Points& from, const Points& to, const std::string& how) {
        return fit_affine(from, to, affine_fit_of(how));
      },
      py::arg("from_points"), py::arg("to_points"), fit);
  module.def("fit_similarity", &similarity, py::arg("from_points"), py::arg("to_points"),
             py::arg("alignment") = "similarity");
  module.def("aligned_to", &aligned_to, py::arg("points"), py::arg("onto"));
  module.def("relative_gap", &relative_gap, py::arg("points"), py::arg("onto"));
}

void define_scores(py::module_& module) {
  py::class_<Score>(module, "Score", "How far a map is from the ground truth; NaN: undefined.")
      .def_readonly("mpe_m", &Score::mpe_m)
      .def_readonly("moe_percent", &Score::moe_percent)
      .def_readonly("mpe_all_fitted_m", &Score::mpe_all_fitted_m)
      .def_readonly("moe_unmirrored_percent", &Score::moe_unmirrored_percent);
  module.def(
      "score_map",
      [](const Points& estimate_m, const Points& ground_truth_m,
         const std::vector<Eigen::Index>& anchors, const std::string& how) {
        return score_map(estimate_m, ground_truth_m, anchors, affine_fit_of(how));
      },
      py::arg("estimate_m"), py::arg("ground_truth_m"),
      py::arg("anchors") = std::vector<Eigen::Index>(), py::arg("fit") = "least_distances");
}

std::vector<std::string> anchor_names(const MapRecord& map) {
  std::vector<std::string> names;
  for (const Eigen::Index row : map.anchors)
    names.push_back(map.names[static_cast<std::size_t>(row)]);
  return names;
}

}  // namespace

AffineFit affine_fit_of(const std::string& word) {
  for (const AffineFit known : {AffineFit::kLeastDistances, AffineFit::kLeastSquares})
    if (name(known) == word) return known;
  throw InvalidInput(fmt::format("fit: least_distances or least_squares, not {}", printable(word)));
}

MethodSetting setting_of(const std::string& method, std::optional<double> parameter) {
  const std::optional<Method> known = method_named(method);
  if (!known)
    throw InvalidInput(fmt::format("method: no {}; did you mean {}?", printable(method),
                                   nearest_method_name(method)));
  const std::optional<ParameterInfo>& tuned = info(*known).parameter;
  if (!parameter) return {*known, {}};
  if (!tuned) throw InvalidInput(fmt::format("parameter: {} has none", method));
  if (!(tuned->minimum <= *parameter && *parameter <= tuned->maximum) ||
      (tuned->integer && *parameter != std::floor(*parameter)))
    throw InvalidInput(fmt::format("parameter: {} of {} is {} from {} to {}, not {}", tuned->symbol,
                                   method, tuned->integer ? "an integer" : "a number",
                                   tuned->minimum, tuned->maximum, *parameter));
  return {*known, parameter};
}

void define_maps(py::module_& module) {
  define_methods(module);
  define_embeddings(module);
  define_alignment(module);
  define_scores(module);
  py::class_<MapRecord>(module, "LandmarkMap", "A map, with what is known of it.")
      .def_readonly("names", &MapRecord::names)
      .def_readonly("positions", &MapRecord::estimate,
                    "M x 2, in m if `frame` is \"ground_truth\"; NaN rows: not mapped")
      .def_readonly("ground_truth_m", &MapRecord::ground_truth_m)
      .def_property_readonly("anchors", &anchor_names)
      .def_readonly("statuses", &MapRecord::statuses)
      .def_readonly("score", &MapRecord::score)
      .def_property_readonly("frame", [](const MapRecord& m) { return std::string(name(m.frame)); })
      .def_property_readonly("sensor",
                             [](const MapRecord& m) { return std::string(sensor_name(m)); })
      .def_property_readonly("method", [](const MapRecord& m) { return method_label(m); })
      .def("figure", [](const MapRecord& m) { return map_figure(m, "map"); })
      .def(
          "json", [](const MapRecord& m) { return map_json(m); }, "What map.json holds.")
      .def("_repr_svg_",
           [](const MapRecord& m) { return figure_svg(map_figure(m, "map"), report_theme()); });
  module.def("map_observations", &map_observations, py::arg("history"), py::arg("method"),
             py::arg("parameter") = py::none(), py::arg("anchors") = Positions(),
             py::arg("ground_truth") = Positions(), py::call_guard<py::gil_scoped_release>(),
             "Maps a history and aligns the map to anchors: name -> (x, y) in m.");
}

}  // namespace mapproof::python
