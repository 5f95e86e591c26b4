#include "app/map/map_json.hpp"

#include <fmt/format.h>

#include "app/map/joint_map_report.hpp"
#include "app/map/map_folder.hpp"
#include "app/map/observations.hpp"
#include "app/result_json.hpp"
#include "core/records/maps/map_files.hpp"
#include "render/figures/score_words.hpp"

namespace mapproof {

namespace fs = std::filesystem;

namespace {

nlohmann::ordered_json landmark_json(const MapResult& map, Eigen::Index i) {
  const MapRecord& record = map.record;
  const std::string unit = record.frame == Frame::kTruth ? "_m" : "";
  nlohmann::ordered_json landmark{{"name", record.names[static_cast<std::size_t>(i)]},
                                  {"x" + unit, number_or_null(record.estimate(i, 0))},
                                  {"y" + unit, number_or_null(record.estimate(i, 1))}};
  if (!map.certainty) return landmark;
  landmark["ellipse"] = nullptr;
  if (const std::optional<Ellipse> ellipse = confidence_ellipse(*map.certainty, i))
    landmark["ellipse"] = {
        {"a" + unit, ellipse->a}, {"b" + unit, ellipse->b}, {"turn_rad", ellipse->turn_rad}};
  return landmark;
}

}  // namespace

nlohmann::ordered_json map_json(const MapResult& map, const fs::path& out) {
  const MapRecord& record = map.record;
  const MethodSetting* setting = setting_of(record);
  nlohmann::ordered_json object{
      {"sensor", sensor_name(record)},
      {"method", method_name(record)},
      {"parameter", setting != nullptr ? parameter_json(*setting) : nullptr},
      {"steps", record.step},
      {"frame", name(record.frame)},
      {"score", nullptr},
      {"landmarks", nlohmann::ordered_json::array()},
      {"statuses", statuses_json(record.statuses)},
      {"labels", nlohmann::ordered_json::array()},
      {"remarks", map.remarks},
      {"warnings", map.warnings},
      {"map", (out / kMapFile).string()},
      {"report", (out / "report.html").string()}};
  if (record.score)
    object["score"] = {
        {"mpe_m", number_or_null(record.score->mpe_m)},
        {"moe_percent", number_or_null(record.score->moe_percent)},
        {"mpe_all_fitted_m", number_or_null(record.score->mpe_all_fitted_m)},
        {"moe_unmirrored_percent", number_or_null(record.score->moe_unmirrored_percent)}};
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i)
    object["landmarks"].push_back(landmark_json(map, i));
  for (const LabelFact& fact : map.labels)
    object["labels"].push_back({{"what", fact.what},
                                {"first", fact.first},
                                {"second", fact.second},
                                {"found", fact.sentence},
                                {"before_m", number_or_null(fact.before_m)},
                                {"after_m", number_or_null(fact.after_m)},
                                {"repaired", fact.repaired}});
  if (map.choice) object["choice"] = choice_json(*map.choice);
  if (map.mixed) object["mixed"] = mixed_json(*map.mixed);
  return object;
}

std::string map_text(const MapResult& map, const fs::path& out) {
  const MapRecord& record = map.record;
  std::string text =
      fmt::format("{}, {}, {} steps", method_label(record), sensor_label(record), record.step);
  if (record.score)
    if (const std::string score = score_words(*record.score); !score.empty()) text += ": " + score;
  return text + "\n" + (out / "report.html").string() + "\n";
}

}  // namespace mapproof
