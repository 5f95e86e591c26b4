#pragma once

#include "core/topics/study_kind.hpp"

namespace mapproof {

/// Maps of simulated worlds by the mapping methods [yairi2007].
extern const StudyKind kMappingStudies;

}  // namespace mapproof
