#include "app/build_facts.hpp"

#include <Spectra/Util/Version.h>
#include <fmt/format.h>
#include <spdlog/version.h>
#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/base/parallel.hpp"
#include "core/base/version.hpp"
#include "render/cairo/library_versions.hpp"

namespace mapproof {

Provenance build_provenance() {
  Provenance provenance{.version = std::string(version()),
                        .commit = std::string(source_commit()),
                        .solver_digest = std::string(solver_digest()),
                        .libraries = {}};
  provenance.libraries = {
      {"Eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Spectra", fmt::format("{}.{}.{}", SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION,
                              SPECTRA_PATCH_VERSION)},
      {"oneTBB", parallel_library_version()},
      {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                    NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"fmt",
       fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"spdlog", fmt::format("{}.{}.{}", SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
      {"CLI11", CLI11_VERSION},
  };
  if (MAPPROOF_HAS_SCENES) provenance.libraries.emplace_back("VTK", MAPPROOF_VTK_VERSION);
  provenance.libraries.emplace_back("g++", __VERSION__);
  for (auto& library : render_library_versions()) provenance.libraries.push_back(library);
  return provenance;
}

nlohmann::ordered_json version_json() {
  struct Dependency {
    const char *name, *version, *licence, *package, *use;
  };
  static constexpr Dependency kDependencies[] = {
#include "dependencies.inc"
  };
  const Provenance provenance = build_provenance();
  nlohmann::ordered_json object{{"version", provenance.version},
                                {"commit", provenance.commit},
                                {"solver_digest", provenance.solver_digest},
                                {"compiler", __VERSION__},
                                {"scenes", bool{MAPPROOF_HAS_SCENES}},
                                {"animation", bool{MAPPROOF_HAS_ANIMATION}},
                                {"dependencies", nlohmann::ordered_json::array()}};
  for (const Dependency& one : kDependencies)
    object["dependencies"].push_back({{"name", one.name},
                                      {"version", one.version},
                                      {"licence", one.licence},
                                      {"package", one.package},
                                      {"use", one.use}});
  return object;
}

std::string version_text() {
  const Provenance provenance = build_provenance();
  std::string text = fmt::format("mapproof {}\ncommit {}\n", provenance.version, provenance.commit);
  for (const auto& [library, version] : provenance.libraries)
    text += fmt::format("{} {}\n", library, version);
  if (!MAPPROOF_HAS_SCENES) text += "3-D figures: left out (MAPPROOF_SCENES=OFF)\n";
  if (!MAPPROOF_HAS_ANIMATION) text += "animations: left out (MAPPROOF_ANIMATION=OFF)\n";
  return text;
}

}  // namespace mapproof
