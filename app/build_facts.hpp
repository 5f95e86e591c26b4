#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/model/study.hpp"

namespace mapproof {

/// This program and what it is linked with: the same for every run of one build.
Provenance build_provenance();

/// What --version prints.
std::string version_text();

/// The same for --version --json, with what the program is made of: versions and SPDX licences.
nlohmann::ordered_json version_json();

}  // namespace mapproof
