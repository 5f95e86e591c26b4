#pragma once

#include "core/topics/study_kind.hpp"

namespace mapproof {

/// Tables of results that other programs wrote.
extern const StudyKind kTableStudies;

}  // namespace mapproof
