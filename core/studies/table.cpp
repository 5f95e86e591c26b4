#include <utility>

#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

void read_table(const fs::path& folder, const std::string&, const ContentsAsked& asked,
                StudyContents& contents) {
  ResultsStudy study = read_results_study(folder);
  for (const Label& setup : study.setups)
    if (!setup.label.empty()) contents.labels.setups[setup.id] = setup.label;
  for (const Label& method : study.methods) contents.labels.add_method(method.id, method.label);
  for (const Label& factor : study.factors)
    contents.labels.factors[factor.id] = {factor.label, factor.unit};
  contents.runs = GroupsByRun(study.results.rows);
  contents.results = std::move(study.results);
  contents.draws_groups = true;
  if (!asked.maps) return;
  try_file(contents, folder, folder / "maps", asked, [&] {
    for (const MapRecord& map : read_given_maps(folder))
      contents.points["maps/" + map.id] = placed(map);
  });
  try_file(contents, folder, folder / "paths", asked, [&] {
    for (const GivenPath& path : read_given_paths(folder))
      contents.points["paths/" + path.id] = placed_path(path.path.positions_m);
  });
  try_file(contents, folder, folder / "errors", asked, [&] {
    for (const PathErrors& errors : read_path_errors(folder))
      contents.points["errors/" + errors.run + "/" + errors.method] =
          placed_path(errors.poses.estimate_m.leftCols<2>());
  });
}

}  // namespace

const StudyKind kTableStudies = {
    .study = kResultsStudy,
    .title = "a table of results",
    .experiment = {},
    .files = {{kResultsStudy, [](auto text, auto& source) { parse_results_study(text, source); }}},
    .records = {"results.csv", "maps", "paths", "errors"},
    .read = read_table,
    .check =
        [](const fs::path& folder) {
          const ResultsStudy study = read_results_study(folder);
          std::vector<std::string> remarks;
          for (const std::string& remark : label_remarks_of(study))
            remarks.push_back((folder / kStudyFile).string() + ": " + remark);
          for (const std::string& remark : remarks_of(study))
            remarks.push_back((folder / kResultsFile).string() + ": " + remark);
          for (const std::string& remark : passed_over_files(folder))
            remarks.push_back((folder / "").string() + remark);
          read_given_maps(folder);
          read_given_paths(folder);
          read_path_errors(folder);
          return remarks;
        },
};

}  // namespace mapproof
