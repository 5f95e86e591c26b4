#include "core/records/studies/study_contents.hpp"

#include "core/base/errors.hpp"
#include "core/records/studies/results_of.hpp"

namespace mapproof {

namespace fs = std::filesystem;

AlignedPoints placed(const MapRecord& map) {
  const bool has_frame = !map.anchors.empty() || map.ground_truth_m;
  const bool is_metric = std::holds_alternative<FromPairs>(map.origin) ||
                         std::holds_alternative<FromRanges>(map.origin);
  return {.quantity = map.frame == Frame::kGroundTruth ? "landmark_m" : "landmark_shape",
          .frame = map.frame,
          .is_free = is_metric && !has_frame && map.frame == Frame::kGroundTruth,
          .names = map.names,
          .points = map.estimate,
          .ground_truth = map.ground_truth_m};
}

AlignedPoints placed_path(const Points& positions_m) {
  return {.quantity = "path_m",
          .frame = Frame::kGroundTruth,
          .names = {},
          .points = positions_m,
          .ground_truth = std::nullopt};
}

void try_file(StudyContents& contents, const fs::path& folder, const fs::path& file,
              const ContentsAsked& asked, const std::function<void()>& read) {
  try {
    read();
  } catch (const IoError& error) {
    if (!asked.keeps_on) throw;
    contents.problems.push_back({file.lexically_relative(folder).generic_string(), error.what()});
  }
}

void add_log(StudyContents& contents, const SlamRun& run) {
  contents.runs.set(run.id, run.id);
  for (const SlamRecord& record : run.records) {
    const std::string id =
        record_name(condition(run.id), std::string(info(record.method).name), run.id);
    contents.points[id] = {.quantity = "landmark_m",
                           .frame = Frame::kGroundTruth,
                           .names = run.log.landmarks,
                           .points = record.estimate.landmarks_m,
                           .ground_truth = run.log.true_landmarks};
    contents.points[id + "/path"] = placed_path(record.estimate.path.positions_m);
  }
  if (run.log.ground_truth)
    contents.worlds[run.id] = placed_path(run.log.ground_truth->positions_m);
}

StudyContents contents_of(const MapRecord& map) {
  StudyContents contents;
  contents.kind = "mapproof.map";
  contents.results = results_of(map);
  contents.runs.set("", "");
  contents.points[map.id] = placed(map);
  return contents;
}

StudyContents contents_of(const SlamRun& run) {
  StudyContents contents;
  contents.kind = "mapproof.slam_run";
  contents.results = results_of(run);
  add_log(contents, run);
  return contents;
}

}  // namespace mapproof
