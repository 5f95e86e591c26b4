#pragma once

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

}  // namespace mapproof
