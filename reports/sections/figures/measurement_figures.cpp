#include "reports/sections/figures/figure_builders.hpp"

#include "render/figures/diagrams/measurement.hpp"

namespace mapproof {
namespace {

/// The first run that has what a scan needs.
void add_measurement(FigureSource& source, const PaperFigure& wanted,
                     std::vector<Figure>& figures) {
  for (const Run& run : source.study().runs)
    if (const SensorDetails* sensor = source.details(run.id, wanted.sensor)) {
      figures.push_back(
          measurement_figure(measurement(*source.details(run.id), *sensor, run.world), wanted.id));
      return;
    }
}

/// The median run of the best method: its walk, how its history begins, and its map.
void add_idea(FigureSource& source, const PaperFigure& wanted, std::vector<Figure>& figures) {
  const Study& study = source.study();
  const SensorStudy* sensor = find_sensor(study.experiment, wanted.sensor);
  if (sensor == nullptr) return;
  const std::vector<SettingSummary> all = source.best(*sensor);
  const SettingSummary* best = best_of(all);
  if (best == nullptr) return;
  const auto id = median_run(study, *best);
  if (!id) return;
  const Run* run = source.run(*id);
  const SensorDetails* details = source.details(*id, wanted.sensor);
  const MapRecord* map = source.map(*id, wanted.sensor, best->setting, best->step);
  if (run == nullptr || details == nullptr || map == nullptr) return;
  figures.push_back(idea_figure({.id = wanted.id,
                                 .world = run->world,
                                 .path_m = source.details(*id)->path.positions_m,
                                 .history = ObservationHistory{.sensor = wanted.sensor,
                                                               .names = map->names,
                                                               .values = details->first_steps},
                                 .map = *map,
                                 .steps = static_cast<int>(details->first_steps.cols())}));
}

}  // namespace

std::vector<Figure> idea_figures(FigureSource& source) {
  std::vector<Figure> figures;
  for (const PaperFigure& figure : source.study().experiment.figures)
    if (figure.kind == FigureKind::kIdea) add_idea(source, figure, figures);
  return figures;
}

std::vector<Figure> measurement_figures(FigureSource& source) {
  std::vector<Figure> figures;
  for (const PaperFigure& figure : source.study().experiment.figures)
    if (figure.kind == FigureKind::kMeasurement) add_measurement(source, figure, figures);
  return figures;
}

}  // namespace mapproof
