#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace mapproof::test {

/// A file of docs/schemas: "values.schema.json".
nlohmann::json schema_file(const std::string& name);

/// What the schema of that name in docs/schemas finds wrong; empty if nothing.
std::string schema_problem(const std::string& name, const nlohmann::json& value);

/// The same of a schema at hand.
std::string schema_problem_of(const nlohmann::json& schema, const nlohmann::json& value);

}  // namespace mapproof::test
