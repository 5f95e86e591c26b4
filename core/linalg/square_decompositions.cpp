#include "core/linalg/decompositions.hpp"

MAPPROOF_SQUARE_DECOMPOSITIONS(template)
