#pragma once

#include <string>

#include "core/model/study.hpp"

namespace mapproof {

/// This program and what it is linked with: the same for every run of one build.
Provenance build_provenance();

/// What --version prints.
std::string version_text();

}  // namespace mapproof
