#include "reports/sections/opening.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "reports/sections/findings.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/study_counts.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostThumbnails = 6;

/// With no break between number and unit.
std::string whole_metres(double value) {
  std::string text = metres(value);
  const std::size_t space = text.find(' ');
  return space == std::string::npos ? text : text.replace(space, 1, "\u00a0");
}

/// "Best by bearing: 0.0615 m mean position error (the paper: 0.0609 m), SMACOF, K = 8. "
void add_best(const SensorStudy& sensor, const SettingSummary* best, Paragraph& text) {
  const std::string by = lower_case(title_of(sensor.sensor.sensor));
  if (best == nullptr) {
    text.phrases.push_back({"By " + by + " no map could be scored. "});
    return;
  }
  const bool is_first = text.phrases.empty();
  text.phrases.push_back({"Best by " + by + ": "});
  text.phrases.push_back({whole_metres(best->mpe_m->mean), Emphasis::kStrong});
  std::string rest = is_first ? " mean position error" : "";
  if (best->published) rest += " (the paper: " + whole_metres(best->published->mpe_m) + ")";
  text.phrases.push_back({rest + ", " + label(best->setting) + ". "});
}

std::string ends(const Study& study) {
  const StudyCounts counts = count(study);
  const std::string maps = counted(counts.maps, "map");
  if (counts.unscored + counts.with_status == 0)
    return fmt::format("None of {} has a warning.", maps);
  return fmt::format("Of {} {} {} warnings, {} {} without a score.", maps, counts.with_status,
                     counts.with_status == 1 ? "has" : "have",
                     counts.unscored == 0 ? "none" : std::to_string(counts.unscored),
                     counts.unscored < 2 ? "is" : "are");
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
