#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "core/base/files.hpp"
#include "render/plot/figure_json.hpp"
#include "tests/support/sample_figures.hpp"

namespace mapproof::test {
namespace {

using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

class FigureSchema : public ::testing::Test {
 protected:
  FigureSchema()
      : document_(json::parse(
            read_file(std::string(MAPPROOF_SOURCE_DIR) + "/docs/schemas/figure.schema.json"))) {
    valijson::SchemaParser().populateSchema(Adapter(document_), schema_);
  }

  std::string problem(const json& value) {
    valijson::ValidationResults results;
    if (valijson::Validator().validate(schema_, Adapter(value), &results)) return {};
    valijson::ValidationResults::Error error;
    results.popError(error);
    std::string place;
    for (const std::string& part : error.context) place += part;
    return place + ": " + error.description;
  }

  json document_;
  valijson::Schema schema_;
};

TEST_F(FigureSchema, HoldsForEveryFigure) {
  for (const Figure& figure : sample_figures())
    EXPECT_EQ(problem(json::parse(figure_to_json(figure))), "") << figure.id;
}

TEST_F(FigureSchema, RefusesWhatTheReaderRefuses) {
  const json good = json::parse(figure_to_json(sample_figures().front()));
  for (const char* key : {"schema", "id", "title", "panels", "records"}) {
    json bad = good;
    bad.erase(key);
    EXPECT_NE(problem(bad), "") << key;
  }
  json bad = good;
  bad["id"] = "../x";
  EXPECT_NE(problem(bad), "");
  bad = good;
  bad["panels"][0]["layers"][0]["kind"] = "pie";
  EXPECT_NE(problem(bad), "");
}

}  // namespace
}  // namespace mapproof::test
