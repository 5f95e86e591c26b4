#pragma once

#include <string>

#include "core/model/study.hpp"

namespace mapproof {

/// The maps of a study by how they ended. One map can count under several.
struct StudyCounts {
  long maps = 0;
  long with_status = 0;  ///< A warning or a failure, of any kind.
  long unscored = 0;     ///< Without a score.
  long failed = 0;       ///< No map at all: kFailed.
};

StudyCounts count(const Study& study);

/// The share of maps with a warning or a failure in whole percent: 0 and 100 are said of none and
/// of all alone.
long warned_percent(const StudyCounts& counts);

/// "2,310 of 25,700 maps (9 %) have warnings, 50 have no score and 4 could not be made".
std::string endings_text(const StudyCounts& counts);

}  // namespace mapproof
