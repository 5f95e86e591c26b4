#pragma once

#include <nlohmann/json.hpp>

#include "core/model/method.hpp"

namespace mapproof {

/// A number of a result; null if it is not finite.
nlohmann::ordered_json number_or_null(double value);

/// A method's parameter; an integer where the method wants one, null where it has none.
nlohmann::ordered_json parameter_json(const MethodSetting& setting);

}  // namespace mapproof
