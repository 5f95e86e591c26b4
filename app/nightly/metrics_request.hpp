#pragma once

#include <optional>
#include <string>

#include "app/nightly/tested_commit.hpp"
#include "app/study/study_request.hpp"
#include "core/results/quantity.hpp"

namespace mapproof {

/// A file of metrics as a study.
struct MetricsRequest {
  StudyRequest study = {};
  TestedCommit commit = {};  ///< What the file says was measured; empty: nothing.
  std::vector<std::string> remarks = {};
};

/// Reads a file of metrics (see parse_metrics()). The study is named by the file itself, else by its
/// name, and is the same one whatever metrics come and go.
/// @throws IoError, InvalidInput.
MetricsRequest read_metrics_request(const std::string& file, std::optional<Better> better);

}  // namespace mapproof
