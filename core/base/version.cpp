#include "core/base/version.hpp"

#include "source_version.inc"

namespace mapproof {

std::string_view version() { return MAPPROOF_VERSION; }

std::string_view source_commit() { return MAPPROOF_COMMIT; }

std::string_view solver_digest() { return MAPPROOF_SOLVER_DIGEST; }

}  // namespace mapproof
