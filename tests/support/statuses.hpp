#pragma once

#include <algorithm>

#include "core/model/embedding.hpp"

namespace mapproof::test {

inline bool has(const Embedding& embedding, StatusCode code) {
  return std::ranges::find(embedding.statuses, code, &Status::code) != embedding.statuses.end();
}

/// The first status for that reason; null if there is none.
inline const Status* status_for(const Embedding& embedding, StatusReason reason) {
  const auto found = std::ranges::find(embedding.statuses, reason, &Status::reason);
  return found == embedding.statuses.end() ? nullptr : &*found;
}

}  // namespace mapproof::test
