#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/model/slam/slam_study.hpp"

namespace mapproof {

/// Adds "errors", each with its alignment, "range_scale" and "statuses" to a result.
void put_slam_errors(nlohmann::ordered_json& result, const SlamRecord& record);

/// One line: method, its error with the alignment, or why there is none.
std::string slam_record_text(const SlamRecord& record);

}  // namespace mapproof
