#include "core/linalg/decompositions.hpp"

MAPPROOF_SINGULAR_VALUE_DECOMPOSITIONS(template)
