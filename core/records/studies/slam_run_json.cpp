#include "core/records/studies/slam_run_json.hpp"

#include "core/json/record_json.hpp"
#include "core/records/studies/slam_fields.hpp"

namespace mapproof {

std::string slam_run_json(const SlamRun& run) { return to_json_text(run); }

SlamRun parse_slam_run(std::string_view text, const std::string& source) {
  return from_json_text<SlamRun>(text, source);
}

std::string convergence_json(const ConvergenceCurve& curve) { return to_json_text(curve); }

ConvergenceCurve parse_convergence(std::string_view text, const std::string& source) {
  return from_json_text<ConvergenceCurve>(text, source);
}

std::string range_histories_json(const RangeHistoryStudy& histories) {
  return to_json_text(histories);
}

RangeHistoryStudy parse_range_histories(std::string_view text, const std::string& source) {
  return from_json_text<RangeHistoryStudy>(text, source);
}

std::string space_run_json(const SpaceRun& run) { return to_json_text(run); }

SpaceRun parse_space_run(std::string_view text, const std::string& source) {
  return from_json_text<SpaceRun>(text, source);
}

}  // namespace mapproof
