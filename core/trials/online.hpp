#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// How far maps that are carried on as observations arrive lie from those of the whole history, and
/// what each takes.
extern const Topic kOnlineTopic;

}  // namespace mapproof
