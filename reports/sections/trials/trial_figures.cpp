#include "reports/sections/trials/trial_figures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "render/figures/level_curve.hpp"
#include "render/figures/measured_map.hpp"
#include "render/figures/pair_distances.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/trials/trial_means.hpp"

namespace mapproof {
namespace {

/// Bands of more lines than these hide each other.
constexpr std::size_t kMostBands = 4;

/// Levels that span more than this are on a logarithmic axis.
constexpr double kWideSpan = 20.0;

/// One series over the levels; a line a data set if there are several.
std::vector<ErrorLine> lines_of(const TrialStudy& study, const TrialSeries& series,
                                std::size_t place, const std::vector<const TrialCell*>& cells,
                                std::size_t quantity) {
  std::vector<ErrorLine> lines;
  for (const TrialCell* cell : cells) {
    const bool is_set = !cell->part.empty() && study.parts.size() > 1;
    const std::string key = is_set ? series.id + "-" + cell->part : series.id;
    auto line = std::ranges::find(lines, key, &ErrorLine::key);
    if (line == lines.end()) {
      ErrorLine fresh;
      fresh.label = is_set ? series.label + ", " + cell->part : series.label;
      fresh.key = key;
      if (!is_set) fresh.series = place;
      line = lines.insert(line, std::move(fresh));
    }
    const std::optional<MeanEstimate>& mean = cell->means[quantity];
    const auto interval = interval_of(mean);
    line->x.push_back(cell->level);
    line->mean.push_back(mean ? mean->mean : kNaN);
    line->low.push_back(interval ? interval->low : kNaN);
    line->high.push_back(interval ? interval->high : kNaN);
  }
  return lines;
}

bool is_known(double value) { return std::isfinite(value); }

/// Takes away lines of which nothing is known, which would be in the legend alone.
void drop_unknown(std::vector<ErrorLine>& lines) {
  std::erase_if(lines,
                [](const ErrorLine& line) { return std::ranges::none_of(line.mean, is_known); });
}

/// Takes the bands away where they are unknown, or too many to be told apart.
void drop_bands(std::vector<ErrorLine>& lines) {
  const bool too_many = lines.size() > kMostBands;
  for (ErrorLine& line : lines)
    if (too_many || std::ranges::none_of(line.low, is_known)) {
      line.low.clear();
      line.high.clear();
    }
}

/// Intervals of percentages end where percentages do.
void clip_percents(std::vector<ErrorLine>& lines) {
  for (ErrorLine& line : lines)
    for (std::vector<double>* ends : {&line.low, &line.high})
      for (double& end : *ends)
        if (is_known(end)) end = std::clamp(end, 0.0, 100.0);
}

/// Takes the level 0 away, which a logarithmic axis does not have.
void drop_zero_level(std::vector<ErrorLine>& lines) {
  for (ErrorLine& line : lines) {
    if (line.x.empty() || line.x.front() != 0.0) continue;
    for (std::vector<double>* values : {&line.x, &line.mean, &line.low, &line.high})
      if (!values->empty()) values->erase(values->begin());
  }
}

bool spans_widely(const std::vector<double>& levels) {
  const auto first = std::ranges::find_if(levels, [](double level) { return level != 0.0; });
  return first != levels.end() && *first > 0.0 && levels.back() > kWideSpan * *first;
}

/// Whether a quantity tells any two cells of a setup apart: what is the same everywhere needs no
/// picture.
bool tells_apart(const std::vector<TrialCell>& cells, const std::string& setup,
                 std::size_t quantity) {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (const TrialCell& cell : cells) {
    if (cell.setup != setup || !cell.means[quantity]) continue;
    least = std::min(least, cell.means[quantity]->mean);
    greatest = std::max(greatest, cell.means[quantity]->mean);
  }
  return greatest > least;
}

std::optional<Figure> curve_figure(const TrialStudy& study, const TrialSetup& setup,
                                   const std::vector<TrialCell>& cells, std::size_t quantity) {
  if (!tells_apart(cells, setup.id, quantity)) return std::nullopt;
  const Quantity& what = study.design.quantities[quantity];
  LevelCurveSpec spec;
  spec.id = fmt::format("{}-{}-{}", id_prefix(study), setup.id, what.id);
  std::ranges::replace(spec.id, '_', '-');
  spec.title = setup.title + ": " + what.label;
  spec.x_label = setup.level_label;
  spec.y_label = label_with_unit(what);
  spec.quantity = what.label;
  for (std::size_t i = 0; i < study.design.series.size(); ++i) {
    const TrialSeries& series = study.design.series[i];
    for (ErrorLine& line :
         lines_of(study, series, i, cells_of(cells, setup.id, series.id), quantity))
      spec.methods.push_back(std::move(line));
  }
  drop_unknown(spec.methods);
  drop_bands(spec.methods);
  if (what.unit == "%") {
    clip_percents(spec.methods);
    spec.log_from = HUGE_VAL;
  }
  if (spans_widely(setup.levels)) {
    spec.x_scale = Scale::kLog;
    drop_zero_level(spec.methods);
  }
  spec.record_ids = {fmt::format("{}, setup {}", study.experiment.name, setup.id)};
  return level_curve_figure(spec);
}

}  // namespace

StudyFigures trial_figures(const TrialStudy& study) {
  StudyFigures figures;
  const std::vector<TrialCell> cells = trial_cells(study);
  for (const TrialSetup& setup : study.design.setups) {
    if (setup.levels.size() < 2) continue;
    FigureGroup group{id_prefix(study) + "-" + setup.id, setup.title, "", {}};
    for (std::size_t i = 0; i < study.design.quantities.size(); ++i)
      if (auto figure = curve_figure(study, setup, cells, i))
        group.figures.push_back(*std::move(figure));
    if (!group.empty()) figures.groups.push_back(std::move(group));
  }
  FigureGroup maps{id_prefix(study) + "-maps", "Maps", "", {}};
  for (const TrialPart& part : study.parts)
    for (const TrialMap& map : part.maps) {
      maps.figures.push_back(measured_map_figure(
          {id_prefix(study) + "-map-" + map.id, map.title, map.map, map.pairs, map.covariances}));
      if (!map.pairs.empty())
        maps.figures.push_back(
            pair_distances_figure({id_prefix(study) + "-pairs-" + map.id,
                                   map.title + ", measured pairs", map.map, map.pairs}));
    }
  if (!maps.empty()) figures.groups.push_back(std::move(maps));
  return figures;
}

}  // namespace mapproof
