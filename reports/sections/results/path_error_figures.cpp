#include "reports/sections/results/path_error_figures.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/text/slug.hpp"
#include "render/figures/maps/path_errors.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/results/results_view.hpp"

namespace mapproof {
namespace {

/// Where a method stands in the study's order; a method that it does not have stands behind.
std::size_t rank_of(const ResultsStudy& study, const std::string& method) {
  const auto found = std::ranges::find(study.methods, method, &Label::id);
  return static_cast<std::size_t>(found - study.methods.begin());
}

/// The methods of one run, in the order of the study.
PathErrorsSpec spec_of(const ResultsStudy& study, std::vector<const PathErrors*> run) {
  std::ranges::stable_sort(
      run, {}, [&](const PathErrors* errors) { return rank_of(study, errors->method); });
  PathErrorsSpec spec;
  const std::vector<std::size_t> series = styles_of(study);
  for (const PathErrors* errors : run) {
    spec.lines.push_back({.label = label_of(study.methods, errors->method),
                          .poses = &errors->poses,
                          .series = series[rank_of(study, errors->method)]});
    spec.record_ids.push_back("errors/" + errors->run + "/" + errors->method);
  }
  return spec;
}

}  // namespace

std::string path_error_prefix(const ResultsStudy& study) { return study.name + "-errors-"; }

std::vector<FigureGroup> path_error_figures(const ResultsStudy& study,
                                            const std::vector<PathErrors>& errors) {
  std::map<std::string, std::vector<const PathErrors*>> runs;
  for (const PathErrors& one : errors) runs[one.run].push_back(&one);
  std::vector<FigureGroup> groups;
  std::set<std::string> ids;
  for (auto& [run, of_run] : runs) {
    const std::string first = bounded_id(path_error_prefix(study) + slug_of(run), kLongestBlockId);
    std::string id = first;
    for (int i = 2; !ids.insert(id).second; ++i) id = fmt::format("{}-{}", first, i);
    const std::string title = runs.size() == 1 ? "Errors of poses" : "Errors of poses, " + run;
    FigureGroup& group = groups.emplace_back(FigureGroup{id, title, "", {}});
    PathErrorsSpec spec = spec_of(study, std::move(of_run));
    const std::string of_run_title = runs.size() == 1 ? "" : run + ": ";
    for (std::size_t i = 0; i < spec.lines.size(); ++i) {
      spec.id = fmt::format("{}-path-{}", id, i + 1);
      spec.title = of_run_title + path_error_finding(spec, i);
      group.figures.push_back(path_error_map_figure(spec, i));
    }
    spec.id = id + "-curves";
    spec.title = of_run_title + path_errors_finding(spec);
    group.figures.push_back(path_error_curves_figure(spec));
    spec.id = id + "-distribution";
    const std::string medians = path_medians_finding(spec);
    spec.title = of_run_title.empty() ? "Half" + medians.substr(4) : of_run_title + medians;
    group.figures.push_back(path_error_distribution_figure(spec));
  }
  return groups;
}

}  // namespace mapproof
