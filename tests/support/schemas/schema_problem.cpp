#include "tests/support/schemas/schema_problem.hpp"

#include <filesystem>
#include <memory>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "core/base/files/files.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

}  // namespace

json schema_file(const std::string& name) {
  return json::parse(read_file(fs::path(MAPPROOF_SOURCE_DIR) / "docs/schemas" / name));
}

std::string schema_problem(const std::string& name, const json& value) {
  return schema_problem_of(schema_file(name + ".schema.json"), value);
}

std::string schema_problem_of(const json& document, const json& value) {
  valijson::Schema schema;
  valijson::SchemaParser parser;
  parser.populateSchema(
      Adapter(document), schema,
      [](const std::string& uri) {
        return std::make_unique<json>(schema_file(fs::path(uri).filename())).release();
      },
      [](const json* fetched) { const std::unique_ptr<const json> owner(fetched); });
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(schema, Adapter(value), &results)) return {};
  valijson::ValidationResults::Error error;
  results.popError(error);
  std::string problem;
  for (const std::string& part : error.context) problem += part;
  return problem + ": " + error.description;
}

}  // namespace mapproof::test
