#pragma once

#include "core/topics/study_kind.hpp"

namespace mapproof {

/// Questions put to many simulated worlds or to data: a Topic of core/trials each.
extern const StudyKind kTrialStudies;

}  // namespace mapproof
