#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/reports/diff/value_cases.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

/// Overwrites one value of a JSON file.
void put(const fs::path& file, const std::string& pointer, const Json& value) {
  Json root = Json::parse(read_file(file));
  root.at(Pointer(pointer)) = value;
  write_file(file, root.dump(1) + "\n");
}

ValueCase field(const std::string& file, const std::string& pointer, const Json& value,
                Verdict verdict, std::vector<std::string> cause) {
  return {.name = file + pointer,
          .id = "records",
          .verdict = verdict,
          .cause = std::move(cause),
          .passes = verdict <= Verdict::kWithinTolerance,
          .change = [=](const fs::path& folder) { put(folder / file, pointer, value); },
          .alone = true};
}

/// A value that no other file holds: the cause names the file and the location.
ValueCase reported(const std::string& file, const std::string& pointer, const Json& value) {
  return field(file, pointer, value, Verdict::kChanged, {file, pointer});
}

ValueCase lost(const std::string& file) {
  return {.name = file + " deleted",
          .id = "records",
          .verdict = Verdict::kMissing,
          .cause = {file + " is missing"},
          .passes = false,
          .change = [=](const fs::path& folder) { fs::remove(folder / file); },
          .alone = true};
}

ValueCase line(const std::string& file, const std::string& from, const std::string& to) {
  return {.name = file + ": " + from,
          .id = "records",
          .verdict = Verdict::kChanged,
          .cause = {file, "line "},
          .passes = false,
          .change =
              [=](const fs::path& folder) {
                std::string text = read_file(folder / file);
                const std::size_t at = text.find(from);
                if (at == std::string::npos) throw std::out_of_range(from);
                write_file(folder / file, text.replace(at, from.size(), to));
              },
          .alone = true};
}

}  // namespace

std::vector<ValueCase> field_cases() {
  const std::string maps = "maps/layout-2-pose-1.json", run = "runs/layout-2-pose-1.json";
  std::vector<ValueCase> cases = {
      reported(maps, "/maps/1/score/mpe_m", 0.5),
      reported(maps, "/maps/1/score/moe_percent", 9.5),
      reported(maps, "/maps/3/score", nullptr),
      reported(maps, "/maps/0/statuses",
               Json::array({{{"code", "bridged"}, {"reason", "message"}, {"names", {"Two."}}}})),
      reported(maps, "/anchors", Json::array({0, 3, 8, 10})),
      field(maps, "/maps/1/score/mpe_m", 0.0, Verdict::kChanged, {"1 number differs"}),
      field(maps, "/names/4", "Other", Verdict::kChanged, {"renamed in record", "L5 \u2192 Other"}),
      reported(run, "/world/side_m", 2.75),
      reported(run, "/world/landmark_diameter_m", 0.05),
      reported(run, "/occlusion", {{"within_reach", 9}, {"hidden", 2}}),
      field(run, "/records/1/iterations", 44, Verdict::kWithinTolerance, {"within tolerance"}),
      field(run, "/records/1/stress", 0.25, Verdict::kChanged, {"stress"}),
      field(run, "/anchors", Json::array({0, 3, 8, 10}), Verdict::kChanged,
            {"different anchors in"}),
      reported("details/layout-2-pose-1.json", "/path/headings_rad", Json::array({0.5})),
      lost(maps),
      lost("details/layout-2-pose-1.json")};
  cases.back().cause = {"details/layout-2-pose-1.json is missing"};
  return cases;
}

std::vector<ValueCase> slam_cases() {
  const std::string run = "runs/drive.json", curve = "convergence/white.json";
  const std::string record = "/records/0/";
  std::vector<ValueCase> cases = {
      field(run, record + "landmarks_m/0/0", 0.15, Verdict::kChanged,
            {"landmark 0 moved 50 mm in record drive/refined"}),
      field(run, record + "path/x_m/1", 0.6, Verdict::kChanged, {"position 2 moved", "drive/ref"}),
      field(run, record + "errors/0/path_mean_m", 0.4, Verdict::kWorse,
            {"mean error of the path 0.2"}),
      field(run, record + "errors/0/path_mean_m", 0.1, Verdict::kBetter,
            {"mean error of the path"}),
      field(run, record + "errors/0/worst_tenth_m", 0.9, Verdict::kWorse, {"worst tenth"}),
      field(run, record + "errors/0/landmarks_m", 0.9, Verdict::kWorse, {"landmarks 0.15"}),
      field(run, record + "range_scale", 1.1, Verdict::kChanged, {"range scale 1.06"}),
      field(run, record + "cost", 200.0, Verdict::kChanged, {"cost 123"}),
      field(run, record + "iterations", 70, Verdict::kWithinTolerance, {"within tolerance"}),
      field(run, record + "statuses", Json::array(), Verdict::kChanged,
            {"warnings of drive/refined"}),
      field(run, record + "range_scale", 1.0625 + 1e-9, Verdict::kWithinTolerance, {"within"}),
      reported(run, record + "error_m/1", 0.25), reported(run, record + "condition", 13.0),
      reported(run, record + "noise_level", 0.06), reported(run, record + "singular_values/2", 2.0),
      reported(run, "/known", Json::array({0, 1})), reported(run, "/windows/chosen_s", 60.0),
      reported(run, "/windows/held_out_m/1", 0.8), reported(run, "/windows", nullptr),
      reported(run, "/simulated", true), reported(run, "/figure", "fig-2c"),
      reported(run, "/starts/0/converged", true),
      field(run, "/starts/0/iterations", 3000, Verdict::kWithinTolerance, {"within tolerance"}),
      reported(run, "/published/poses", 9659), reported(run, "/log/ranges/range_m/0", 3.5),
      field(run, "/log/true_landmarks_m/0/1", 1.25, Verdict::kChanged,
            {"the true position of landmark 0 moved 250 mm"}),
      reported(run, "/log/odometry/heading_change_rad/0", 0.3),
      field(run, "/log/landmarks/0", "other", Verdict::kChanged,
            {"renamed in record drive/ekf: 0 \u2192 other"}),
      reported(run, "/upgrade/steps/1", 1),
      field(run, "/log/ground_truth/x_m/1", 0.7, Verdict::kChanged,
            {"the true position of position 2 moved", "in drive"}),
      field(curve, "/points/0/landmarks_m/mean", 0.5, Verdict::kWorse,
            {"mean error of landmarks 0.02", " of convergence/white, ", ", 50 steps"}),
      field(curve, "/points/1/sine/mean", 1e-4, Verdict::kBetter, {"canonical angle"}),
      reported(curve, "/points/0/landmarks_m/half_width", 0.5),
      reported(curve, "/points/0/bound", 0.5), reported(curve, "/slope", -0.6),
      reported(curve, "/title", "pink noise"),
      field("histories.json", "/maps/0/positions_m/1/0", 0.75, Verdict::kChanged,
            {"landmark 2 moved 250 mm in record histories/squared/isomap-K3"}),
      field("histories.json", "/maps/0/score/mpe_all_fitted_m", 0.5, Verdict::kWorse,
            {"fitted to all landmarks 0.25"}),
      reported("histories.json", "/steps", 11),
      // A parameter may follow from the data: the record is the same.
      reported("histories.json", "/maps/0/K", 4),
      reported("space.json", "/records/0/landmarks_m/0/2", 0.2),
      reported("space.json", "/records/0/landmarks_error_m", 0.5),
      reported("space.json", "/known/1", 3), reported("space.json", "/noise", "other noise"),
      lost("space.json"), lost("histories.json"), lost(curve), lost("paths/drive/refined.tum"),
      lost("paths/drive/refined.csv"), line("paths/drive/refined.csv", "0.25", "0.35"),
      line("paths/drive/refined.tum", "0.25", "0.35")};
  cases.push_back({.name = "a run deleted",
                   .id = "records",
                   .verdict = Verdict::kMissing,
                   .cause = {"missing run: drive"},
                   .passes = false,
                   .change = [=](const fs::path& folder) { fs::remove(folder / run); },
                   .alone = true});
  return cases;
}

}  // namespace mapproof::test
