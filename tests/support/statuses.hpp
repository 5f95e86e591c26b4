#pragma once

#include <algorithm>
#include <string>

#include "core/model/embedding.hpp"

namespace mapproof::test {

inline bool has(const Embedding& embedding, StatusCode code) {
  return std::ranges::find(embedding.statuses, code, &Status::code) != embedding.statuses.end();
}

/// The detail of the first status of that code; empty if there is none.
inline std::string detail_of(const Embedding& embedding, StatusCode code) {
  const auto found = std::ranges::find(embedding.statuses, code, &Status::code);
  return found == embedding.statuses.end() ? "" : found->detail;
}

}  // namespace mapproof::test
