#include <algorithm>
#include <iterator>
#include <string_view>

#include "core/base/words.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/sections/variation_summary.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

/// How the ids of film strips begin (docs/figures.md).
constexpr std::string_view kForming = "forming-";

}  // namespace

FigureBlock figure_block(const Figure& figure) {
  FigureBlock block{figure.id, figure.title, figure.caption, figure.alt, figure.record_ids};
  if (!figure.id.starts_with(kForming)) return block;
  for (const Panel& panel : figure.panels) block.steps.push_back(panel.title);
  return block;
}

FigureBlock figure_block(const Scene& scene) {
  return {scene.id, scene.title, scene.caption, scene.alt, scene.record_ids, "scene"};
}

Gallery gallery_of(const FigureGroup& group, std::size_t first) {
  Gallery gallery;
  for (const Figure& figure : group.figures) gallery.figures.push_back(figure_block(figure));
  for (const Scene& scene : group.scenes) gallery.figures.push_back(figure_block(scene));
  gallery.figures.erase(gallery.figures.begin(),
                        gallery.figures.begin() + static_cast<std::ptrdiff_t>(first));
  return gallery;
}

Section figures_section(const FigureGroup& group) {
  Section section{group.id, group.title, {}};
  section.blocks.emplace_back(plain(group.words));
  section.blocks.emplace_back(gallery_of(group));
  return section;
}

std::optional<Section> variations_section(const Study& study) {
  if (study.experiment.variations.empty()) return std::nullopt;
  Section section{"variations", "Variations", {}};
  section.blocks.emplace_back(
      plain("The numbers behind the figures of anchors, noise and missing entries, one thing "
            "changed at a time."));
  for (const Variation& variation : study.experiment.variations)
    section.blocks.emplace_back(variation_table(study, variation));
  return section;
}

}  // namespace mapproof
