#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// A page shows so many figures of a group before it folds the others.
inline constexpr std::size_t kFiguresOpen = 4;

/// In the title of a figure of methods that ranks none of them: their intervals overlap, or runs
/// are too few for intervals.
inline constexpr const char* kNoneIsBest = "no method is clearly the best";
inline constexpr const char* kTooFewRuns = "too few runs to rank the methods";

/// Figures that stand together in a report.
struct FigureGroup {
  std::string id;  ///< Of its section, [a-z0-9-]+.
  std::string title;
  std::string words;  ///< What they have in common, a sentence or two.
  std::vector<Figure> figures;
  std::vector<Scene> scenes = {};   ///< They stand after the figures.
  std::vector<Film> films = {};     ///< Of scenes of the same ids, drawn when they are asked for.
  std::size_t open = kFiguresOpen;  ///< A page shows so many of them and folds the rest.
  Interest interest = Interest::kSome;  ///< Of its section.
  std::string folded = {};              ///< As of Gallery.

  bool empty() const { return figures.empty() && scenes.empty(); }
};

struct StudyFigures {
  std::vector<FigureGroup> groups;  ///< None is empty.
};

/// The figures that a study's report shows, in its order; those that the records do not allow are
/// left out. docs/figures.md lists their ids.
/// @param read  Asked once for each run that something is shown of.
StudyFigures study_figures(const Study& study, std::span<const Timing> timings,
                           const StudyReader& read);

/// All figures, in the order of the report. The pointers hold as long as `figures`.
std::vector<const Figure*> all_figures(const StudyFigures& figures);

/// All scenes likewise.
std::vector<const Scene*> all_scenes(const StudyFigures& figures);

/// All films likewise.
std::vector<const Film*> all_films(const StudyFigures& figures);

/// Where a figure or a scene stands in a report.
FigureBlock figure_block(const Figure& figure);
FigureBlock figure_block(const Scene& scene);

/// The group's figures and scenes from the `first` one on, side by side.
Gallery gallery_of(const FigureGroup& group, std::size_t first = 0);

}  // namespace mapproof
