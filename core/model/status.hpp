#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/model/method.hpp"
#include "core/model/status_reason.hpp"

namespace mapproof {

/// Sub-maps that ended so, of all.
struct SubmapCount {
  int count = 0;
  int submaps = 0;

  bool operator==(const SubmapCount&) const = default;
};

/// One warning or failure, with what was done about it.
struct Status {
  StatusCode code;
  StatusReason reason;
  std::vector<double> values = {};                    ///< As many as info(reason) has.
  std::vector<std::string> names = {};                ///< Of landmarks; of kMessage the message.
  std::vector<Method> starts = {};                    ///< Empty: of the map itself; else of the map
                                                      ///< that it started from, or of that one's.
  std::optional<SubmapCount> submaps = std::nullopt;  ///< Of the first of these.

  bool operator==(const Status&) const = default;
};

/// A status for that reason.
template <StatusReason kReason, typename... Values>
Status status_of(std::vector<std::string> names, Values... values) {
  static_assert(sizeof...(Values) == info(kReason).value_count());
  return {.code = info(kReason).code,
          .reason = kReason,
          .values = {static_cast<double>(values)...},
          .names = std::move(names)};
}

template <StatusReason kReason, typename... Values>
requires((std::is_arithmetic_v<Values> && ...)) Status status_of(Values... values) {
  static_assert(info(kReason).names == StatusNames::kNone ||
                info(kReason).names == StatusNames::kIfKnown);
  return status_of<kReason>(std::vector<std::string>(), values...);
}

/// What somebody else said, who has no reason of ours.
Status status_with_message(StatusCode code, std::string message);

}  // namespace mapproof
