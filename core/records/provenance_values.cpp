#include "core/records/provenance_values.hpp"

namespace mapproof {

using Json = nlohmann::ordered_json;

Json provenance_value(const Provenance& provenance) {
  Json libraries = Json::array();
  for (const auto& [library, version] : provenance.libraries)
    libraries.push_back({{"name", library}, {"version", version}});
  return {{"version", provenance.version},
          {"commit", provenance.commit},
          {"solver_digest", provenance.solver_digest},
          {"libraries", std::move(libraries)}};
}

Provenance read_provenance(const JsonCursor& value) {
  value.allow_only({"version", "commit", "solver_digest", "libraries"});
  Provenance provenance{.version = value.at("version").text(),
                        .commit = value.at("commit").text(),
                        .solver_digest = value.at("solver_digest").text(),
                        .libraries = {}};
  for (const JsonCursor& library : value.at("libraries").elements(0, 1000)) {
    library.allow_only({"name", "version"});
    provenance.libraries.emplace_back(library.at("name").text(), library.at("version").text());
  }
  return provenance;
}

}  // namespace mapproof
