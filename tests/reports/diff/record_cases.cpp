#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "render/plot/figure_json.hpp"
#include "tests/reports/diff/small_study.hpp"
#include "tests/reports/diff/value_cases.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const SmallStudy& base() {
  static const SmallStudy study;
  return study;
}

}  // namespace

void write_changed(const SmallStudy& study, const fs::path& folder) {
  for (const char* part : {"study.json", "runs", "maps", "details", "timings.jsonl"})
    fs::remove_all(folder / part);
  study.write_records(folder / "records");
  for (const auto& entry : fs::directory_iterator(folder / "records"))
    fs::rename(entry.path(), folder / entry.path().filename());
  fs::remove(folder / "records");
  const std::vector<Figure> before = base().figures(), after = study.figures();
  for (const Figure& figure : after)
    if (std::ranges::find(before, figure) == before.end())
      write_study_figure(figure, report_theme(), folder);
}

namespace {

ValueCase changed_study(const std::string& name, const std::string& id, Verdict verdict,
                        std::vector<std::string> cause,
                        const std::function<void(SmallStudy&)>& change) {
  return {.name = name,
          .id = id,
          .verdict = verdict,
          .cause = std::move(cause),
          .passes = verdict <= Verdict::kWithinTolerance,
          .change =
              [change](const fs::path& folder) {
                SmallStudy study;
                change(study);
                write_changed(study, folder);
              },
          .alone = false};
}

void scale_errors(MapRecord& map, double by) {
  map.estimate = *map.ground_truth_m + by * (map.estimate - *map.ground_truth_m);
}

void add_seeds(std::vector<ValueCase>& cases) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 8U, 4000U}) {
    const std::string words = fmt::format("seed 7 \u2192 {}", seed);
    for (const char* id : {"records", "map-isomap", "mpe-curve"})
      cases.push_back(
          {.name = fmt::format("seed {}, {}", seed, id),
           .id = id,
           .verdict = Verdict::kChanged,
           .cause = {words, "different seeds or true positions"},
           .passes = false,
           .change = [seed](const fs::path& folder) { write_changed(SmallStudy(seed), folder); },
           .alone = false});
  }
}

/// One landmark of one run moves outward: too little for a test over the seeds, but always
/// reported.
void add_moves(std::vector<ValueCase>& cases) {
  for (const char* method : {"lpca", "isomap-K6"})
    for (const int row : {3, 5, 9})
      for (const double moved_m : {0.001, 0.002, 0.005, 0.01, 0.041, 0.1, 0.3, 1.0}) {
        const std::string record = fmt::format("layout-2-pose-1/visibility/{}/200", method);
        const std::string words =
            moved_m < 1.0 ? fmt::format("landmark L{} moved {:.3g} mm", row + 1, 1000.0 * moved_m)
                          : fmt::format("landmark L{} moved 1 m", row + 1);
        const auto change = [=](SmallStudy& study) {
          MapRecord& map = study.map(record);
          const Eigen::RowVector2d error = map.estimate.row(row) - map.ground_truth_m->row(row);
          map.estimate.row(row) += moved_m * error.normalized();
          study.rescore();
        };
        std::vector<std::string> cause = {words, "in record " + record};
        if (row != 3) cause.insert(cause.end(), {"MPE ", "p = "});  // Row 3 is an anchor.
        const std::string map_id = std::string("map-") + (method[0] == 'l' ? "lpca" : "isomap");
        for (const std::string& id : {std::string("records"), map_id})
          cases.push_back(
              changed_study(fmt::format("{} of {} by {} m, {}", row + 1, method, moved_m, id), id,
                            Verdict::kChanged, cause, change));
      }
}

/// A whole map is mirrored, rotated, scaled or shifted.
void add_transforms(std::vector<ValueCase>& cases) {
  const auto add = [&](const std::string& words, const Eigen::Matrix2d& by,
                       const Eigen::RowVector2d& shift) {
    const auto change = [by, shift](SmallStudy& study) {
      Points& estimate = study.map("layout-2-pose-1/visibility/lpca/200").estimate;
      estimate = (estimate * by.transpose()).rowwise() + shift;
      study.rescore();
    };
    for (const char* id : {"records", "map-lpca"})
      cases.push_back(changed_study(words + ", " + id, id, Verdict::kChanged,
                                    {"the map of 12 landmarks is " + words}, change));
  };
  const Eigen::RowVector2d none(0.0, 0.0);
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  add("mirrored", Eigen::Vector2d(-1.0, 1.0).asDiagonal(), none);
  add("mirrored and scaled by 1.1", Eigen::Vector2d(1.1, -1.1).asDiagonal(), none);
  add("rotated by 90\u00B0", Eigen::Rotation2Dd(std::numbers::pi / 2).toRotationMatrix(), none);
  add("rotated by -30\u00B0", Eigen::Rotation2Dd(-std::numbers::pi / 6).toRotationMatrix(), none);
  add("scaled by 1.1", 1.1 * same, none);
  add("shifted by 0.5 m", same, {0.3, -0.4});
}

void add_tolerated(std::vector<ValueCase>& cases) {
  for (const double moved_m : {1e-12, 1e-10, 1e-8})
    for (const char* id : {"records", "map-isomap"})
      cases.push_back(changed_study(
          fmt::format("all landmarks by {} m, {}", moved_m, id), id, Verdict::kWithinTolerance,
          {"within tolerance"}, [=](SmallStudy& study) {
            study.for_each_map("visibility/isomap-K6/200",
                               [=](MapRecord& map) { map.estimate.array() += moved_m; });
            study.rescore();
          }));
}

/// A method gets worse or better by the same in every run.
void add_trends(std::vector<ValueCase>& cases) {
  for (const char* method : {"lpca", "isomap-K6"})
    for (const double by : {0.5, 0.8, 0.95, 1.05, 1.2, 1.5, 2.0}) {
      const std::string subject = fmt::format("visibility/{}/200", method);
      const Verdict verdict = by > 1.0 ? Verdict::kWorse : Verdict::kBetter;
      const auto change = [=](SmallStudy& study) {
        study.for_each_map(subject, [=](MapRecord& map) { scale_errors(map, by); });
        study.rescore();
      };
      cases.push_back(changed_study(fmt::format("{} errors x {}", method, by), "records", verdict,
                                    {"MPE ", "the changes are equal", subject}, change));
      cases.push_back(changed_study(fmt::format("{} errors x {}, its map", method, by),
                                    std::string("map-") + (method[0] == 'l' ? "lpca" : "isomap"),
                                    verdict, {"landmark L", "mm", "MPE "}, change));
      cases.push_back(changed_study(fmt::format("{} errors x {}, the curve", method, by),
                                    "mpe-curve", verdict,
                                    {"MPE ", std::string("visibility, ") +
                                                 (method[0] == 'l' ? "LPCA" : "ISOMAP, K = 6") +
                                                 ", 200 steps"},
                                    change));
    }
}

/// Half of the runs get better, half worse.
void add_mixed(std::vector<ValueCase>& cases) {
  for (const double by : {1.1, 1.3, 1.6})
    cases.push_back(changed_study(fmt::format("mixed by {}", by), "records", Verdict::kChanged,
                                  {"neither better nor worse over the runs", "p = "},
                                  [=](SmallStudy& study) {
                                    for (auto& [run, maps] : study.maps)
                                      scale_errors(maps[0], run.layout % 2 ? by : 1.0 / by);
                                    study.rescore();
                                  }));
}

void add_parameters(std::vector<ValueCase>& cases) {
  for (const double neighbours : {4.0, 5.0, 7.0, 9.0})
    for (const double by : {0.7, 1.4}) {
      const Verdict verdict = by > 1.0 ? Verdict::kWorse : Verdict::kBetter;
      cases.push_back(
          {.name = fmt::format("K = {}, errors x {}", neighbours, by),
           .id = "records",
           .verdict = verdict,
           .cause = {"methods/isomap/K [6] \u2192", fmt::format("[{}]", neighbours), "MPE "},
           .passes = false,
           .change =
               [=](const fs::path& folder) {
                 SmallStudy study(7, 8, neighbours);
                 study.for_each_map(fmt::format("visibility/isomap-K{}/200", neighbours),
                                    [=](MapRecord& map) { scale_errors(map, by); });
                 study.rescore();
                 write_changed(study, folder);
               },
           .alone = false});
    }
}

void add_runs(std::vector<ValueCase>& cases) {
  for (const int layouts : {6, 7, 9, 10})
    cases.push_back(
        {.name = fmt::format("{} layouts", layouts),
         .id = "records",
         .verdict = layouts < 8 ? Verdict::kMissing : Verdict::kNew,
         .cause = {"layouts 8", layouts < 8 ? "missing run" : "new run"},
         .passes = false,
         .change = [=](const fs::path& folder) { write_changed(SmallStudy(7, layouts), folder); },
         .alone = false});
  cases.push_back(changed_study("a status more", "records", Verdict::kChanged,
                                {"warnings of layout-3-pose-1", "bridged"}, [](SmallStudy& study) {
                                  study.study.runs[2].records[1].statuses.push_back(
                                      status_with_message(StatusCode::kBridged, "Two pieces."));
                                }));
  cases.push_back(
      changed_study("a score lost", "records", Verdict::kWorse, {"lost in 1 run"},
                    [](SmallStudy& study) { study.study.runs[2].records[1].score.reset(); }));
  cases.push_back(
      changed_study("another commit", "records", Verdict::kIdentical, {}, [](SmallStudy& study) {
        study.study.provenance.commit = "fedcba987654";
        study.study.provenance.libraries[0].second = "3.4.1";
      }));
}

}  // namespace

void write_base_study(const fs::path& folder) {
  base().write_records(folder);
  for (const Figure& figure : base().figures()) write_study_figure(figure, report_theme(), folder);
}

std::vector<ValueCase> record_cases() {
  std::vector<ValueCase> cases;
  add_seeds(cases);
  add_moves(cases);
  add_transforms(cases);
  add_tolerated(cases);
  add_trends(cases);
  add_mixed(cases);
  add_parameters(cases);
  add_runs(cases);
  return cases;
}

}  // namespace mapproof::test
