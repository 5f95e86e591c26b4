#pragma once

#include <string_view>

namespace mapproof {

/// Facts about this build, set by the build system.
std::string_view version();
std::string_view source_commit();  ///< "unknown" outside a checkout; "-dirty" behind it if changed.
std::string_view solver_digest();  ///< SHA-256 over the sources of core that compute.

}  // namespace mapproof
