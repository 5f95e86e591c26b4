#include "reports/sections/opening.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/sections/findings.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/study_counts.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostThumbnails = 6;

/// "Bearing: SMACOF, K = 8 maps best, mean position error 0.0615 m (the paper: 0.0609 m). "
void add_best(const SensorStudy& sensor, const SettingSummary* best, Paragraph& text) {
  text.phrases.push_back({title_of(sensor.sensor.sensor), Emphasis::kStrong});
  if (best == nullptr) {
    text.phrases.push_back({": no map could be scored. "});
    return;
  }
  text.phrases.push_back({": " + label(best->setting) + " maps best, "});
  text.phrases.push_back({"mean position error " + metres(best->mpe_m->mean), Emphasis::kStrong});
  text.phrases.push_back(
      {best->published ? " (the paper: " + metres(best->published->mpe_m) + "). " : ". "});
}

std::string ends(const Study& study) {
  const StudyCounts counts = count(study);
  const std::string maps = fmt::format("Of {} from {}, ", counted(counts.maps, "map"),
                                       counted(std::ssize(study.runs), "run"));
  if (counts.unscored + counts.with_status == 0) return maps + "every one ended well.";
  return maps + fmt::format("{} {} without a score and {} {} a status.",
                            counts.unscored == 0 ? "none" : std::to_string(counts.unscored),
                            counts.unscored < 2 ? "is" : "are", counts.with_status,
                            counts.with_status == 1 ? "carries" : "carry");
}

/// The first figure or scene of the group; empty if there is none.
std::string first_of(const StudyFigures& figures, const std::string& group) {
  const auto found = std::ranges::find(figures.groups, group, &FigureGroup::id);
  if (found == figures.groups.end()) return "";
  return found->figures.empty() ? found->scenes.front().id : found->figures.front().id;
}

}  // namespace

std::vector<std::string> present_ids(const std::vector<std::string>& ids,
                                     const StudyFigures& figures, std::size_t most) {
  std::vector<std::string> there, chosen;
  for (const Figure* figure : all_figures(figures)) there.push_back(figure->id);
  for (const Scene* scene : all_scenes(figures)) there.push_back(scene->id);
  for (const std::string& id : ids)
    if (chosen.size() < most && std::ranges::find(there, id) != there.end() &&
        std::ranges::find(chosen, id) == chosen.end())
      chosen.push_back(id);
  return chosen;
}

Opening study_opening(const Study& study, const StudyFigures& figures) {
  Opening opening;
  Paragraph text;
  std::vector<std::string> ids = {first_of(figures, "curves")};
  for (const SensorStudy& sensor : study.experiment.sensors) {
    const auto methods = best_of_each_method(summarize(study, sensor, last_step(sensor)));
    const SettingSummary* best = best_of(methods);
    add_best(sensor, best, text);
    if (best != nullptr)
      ids.push_back(fmt::format("map-{}-{}", name(best->sensor), info(best->setting.method).name));
  }
  text.phrases.push_back({ends(study)});
  opening.findings.push_back(std::move(text));
  for (const char* group : {"forming", "comparison", "scenes", "parameters", "observations"})
    ids.push_back(first_of(figures, group));
  opening.figure_ids = present_ids(ids, figures, kMostThumbnails);
  return opening;
}

}  // namespace mapproof
