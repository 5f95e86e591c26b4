#pragma once

#include "core/trials/topic.hpp"

namespace mapproof {

/// How well what can be told of maps without the truth picks among methods and parameters.
extern const Topic kChoiceTopic;

}  // namespace mapproof
