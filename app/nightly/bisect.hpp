#pragma once

#include <filesystem>

#include "app/console.hpp"
#include "app/nightly/nightly_study.hpp"

namespace mapproof {

/// What `git bisect run` asks of a commit.
struct BisectTask {
  std::filesystem::path store;
  int since = 0;  ///< The nightly run in which the regression began.
  int jobs = 1;
  SessionNames names;
};

/// Makes the studies in a folder that is removed again, and compares what got worse in nightly run
/// `since` with it and with the nightly run before: the value that is nearer decides. Nothing is
/// recorded.
/// @return kDone if all are nearer to the values before, kNo if one is nearer to those that got
///         worse, kCannotTest if a study was not finished or nothing can be compared.
/// @throws IoError, InvalidInput.
int bisect(const NightlyRequests& requests, const BisectTask& task, const Console& console);

}  // namespace mapproof
