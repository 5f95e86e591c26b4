#include "app/slam/slam_json.hpp"

#include <fmt/format.h>

#include "app/result_json.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/status_text.hpp"
#include "reports/model/format.hpp"

namespace mapproof {

void put_slam_errors(nlohmann::ordered_json& result, const SlamRecord& record) {
  result["range_scale"] = number_or_null(record.estimate.range_scale);
  result["errors"] = nlohmann::ordered_json::array();
  for (const TrajectoryError& error : record.errors)
    result["errors"].push_back(
        {{"alignment", name(error.alignment)},
         {"path_mean_m", number_or_null(error.mean_m)},
         {"path_rmse_m", number_or_null(error.rmse_m)},
         {"landmarks_m", error.landmarks_m ? number_or_null(*error.landmarks_m)
                                           : nlohmann::ordered_json(nullptr)}});
  result["statuses"] = statuses_json(record.estimate.statuses);
}

std::string slam_record_text(const SlamRecord& record) {
  const std::string method = fmt::format("{:<30}", info(record.method).label);
  if (record.estimate.path.size() == 0)
    return method + "  no path" +
           (record.estimate.statuses.empty() ? ""
                                             : ": " + status_text(record.estimate.statuses.back()));
  if (record.errors.empty())
    return method + fmt::format("  {}, no ground truth to compare them with",
                                counted(record.estimate.path.size(), "pose"));
  const TrajectoryError& error = record.errors.front();
  return method + fmt::format("  mean error {}, alignment {}", error_text(error.mean_m),
                              name(error.alignment));
}

}  // namespace mapproof
