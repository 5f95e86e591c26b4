#pragma once

#include <functional>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/study.hpp"
#include "render/plot/figure.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// The figures of one sensor's part of a study.
struct SensorFigures {
  Sensor sensor = Sensor::kVisibility;
  std::vector<Figure> curves;
  std::vector<Figure> maps;
};

struct StudyFigures {
  std::vector<SensorFigures> sensors;
};

/// Gives the maps of one run.
using MapReader = std::function<std::vector<MapRecord>(const RunId&)>;

/// The figures that a study's report shows.
///
/// For each sensor: MPE and MOE over the steps (mean over runs, 95 % interval), each method at its
/// best parameter: "mpe-bearing-global" for LPCA and SMACOF, "mpe-bearing-graph" for the methods on
/// a neighbour graph; and for each method the map of the run with median MPE at the last
/// checkpoint: "map-bearing-isomap".
///
/// @param read_maps Called once for each run that a map is shown of; a map it does not give is
///                  left out.
StudyFigures study_figures(const Study& study, const MapReader& read_maps);

/// All figures, in the order of the report. The pointers hold as long as `figures`.
std::vector<const Figure*> all_figures(const StudyFigures& figures);

/// Where a figure stands in a report.
FigureBlock figure_block(const Figure& figure);

}  // namespace mapproof
