#include <fmt/format.h>

#include "reports/sections/study_report.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {

FigureBlock figure_block(const Figure& figure) {
  return {figure.id, figure.title, figure.caption, figure.alt, figure.record_ids};
}

Section curves_section(const StudyFigures& figures) {
  Section section{"curves", "Error over observations", {}};
  section.blocks.emplace_back(
      plain("Mean over runs; bands are 95 % intervals of the mean, layouts being the units. Each "
            "method stands with its best parameter at the last checkpoint."));
  Gallery gallery;
  for (const SensorFigures& sensor : figures.sensors)
    for (const Figure& figure : sensor.curves) gallery.figures.push_back(figure_block(figure));
  if (gallery.figures.empty())
    section.blocks.emplace_back(plain("No curve could be drawn: no map was scored."));
  else
    section.blocks.emplace_back(std::move(gallery));
  return section;
}

Section maps_section(const StudyFigures& figures) {
  Section section{"maps", "Maps", {}};
  section.blocks.emplace_back(
      plain("For each method the run whose MPE is the median at the last checkpoint: neither its "
            "best map nor its worst."));
  Gallery gallery;
  for (const SensorFigures& sensor : figures.sensors)
    for (const Figure& figure : sensor.maps) gallery.figures.push_back(figure_block(figure));
  if (gallery.figures.empty())
    section.blocks.emplace_back(plain("No map could be shown."));
  else
    section.blocks.emplace_back(std::move(gallery));
  return section;
}

}  // namespace mapproof
