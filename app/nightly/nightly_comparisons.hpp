#pragma once

#include <string>
#include <vector>

#include "app/nightly/history_report.hpp"

namespace mapproof {

/// Two nightly runs, the older one first, and studies that both have.
struct NightlyPair {
  int before = 0;
  int after = 0;
  std::vector<std::string> studies = {};
};

/// Compares each study of two nightly runs as `mapproof diff` does, and writes the page of each (see
/// comparison_file()). A study whose files are not there any more is left out.
/// @return The files of the pages, below the folder of the pages. @throws IoError, InvalidInput.
std::vector<std::string> write_comparisons(const NightlyPair& pair, const HistoryOutputs& outputs);

}  // namespace mapproof
