#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "core/model/fit.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// A number of a result; null if it is not finite.
nlohmann::ordered_json number_or_null(double value);

/// Statuses as records hold them, each with its sentence as "detail".
nlohmann::ordered_json statuses_json(const std::vector<Status>& statuses);

/// A fit as records hold it, with its words and those of each cause as "detail".
nlohmann::ordered_json fit_json(const Fit& fit);

/// A method's parameter; an integer where the method wants one, null where it has none.
nlohmann::ordered_json parameter_json(const MethodSetting& setting);

}  // namespace mapproof
