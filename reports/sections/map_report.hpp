#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/map_uncertainty.hpp"
#include "core/model/study.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// One map made from user observations, and what came before it.
struct MapReportInput {
  const MapRecord& record;
  std::string title;  ///< "Map of observations.csv".
  /// What was read, in words: {"File", "observations.csv"}, {"Landmarks", "50"}, …
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::string> remarks;        ///< "line 7: no bearing, row dropped", …
  std::vector<std::string> warnings = {};  ///< Before the map is trusted; shown first.
  FigureBlock figure;                      ///< figure_block(map_figure(record, id)).
  std::vector<FigureBlock> more_figures;   ///< Below it.
  Provenance provenance;
  std::string command;              ///< The one that makes it again, ready to be typed.
  std::vector<Section> more = {};   ///< After the landmarks: what else was asked for.
  std::optional<Section> fit = {};  ///< At the head: see fit_section().
  std::string verdict = {};         ///< On the fit, a sentence: see verdict_text().
  std::optional<Highlights::Item> fit_number = {};  ///< See fit_number().
};

/// Opening, summary, figure, landmarks (with errors where the ground truth is known), remarks,
/// statuses, provenance.
Report map_report(const MapReportInput& input);

/// Uncertainty of each landmark of a map: half axes and angle of its ellipse, the largest first.
/// @throws InvalidInput unless there is a covariance a landmark.
Section uncertainty_section(const MapRecord& record, const MapUncertainty& uncertainty);

/// The verdict on the fit, and the anchor that the map contradicts, if any, which the fit to the
/// data does not show.
std::string with_anchors(const std::string& verdict, const MapRecord& record);

/// Over which landmarks the MPE of a map is: "26 landmarks, without the 4 anchors"; empty without
/// an MPE.
std::string scored_landmarks_text(const MapRecord& record);

}  // namespace mapproof
