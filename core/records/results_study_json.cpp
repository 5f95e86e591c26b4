#include "core/records/results_study_json.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/json/json_cursor.hpp"
#include "core/records/quantity_values.hpp"
#include "core/records/results_table.hpp"
#include "core/records/study_store.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLabels = 10'000;  ///< Quantities, setups, methods, factors.
constexpr std::size_t kLongestStudyName = 100;

bool is_study_name(std::string_view name) {
  const auto is_in = [&](std::string_view known) {
    return name.find_first_not_of(known) == std::string_view::npos;
  };
  return !name.empty() && name.front() >= 'a' && name.front() <= 'z' &&
         is_in("abcdefghijklmnopqrstuvwxyz0123456789-");
}

std::vector<Label> read_labels(const JsonCursor& list, bool has_unit) {
  std::vector<Label> labels;
  std::set<std::string> ids;
  for (const JsonCursor& value : list.elements(0, kMostLabels)) {
    if (has_unit)
      value.allow_only({"id", "label", "unit"});
    else
      value.allow_only({"id", "label"});
    Label label{.id = value.at("id").text(1000), .label = value.at("label").text(1000)};
    if (label.label.empty()) value.at("label").fail("is empty");
    if (const auto unit = value.find("unit")) label.unit = unit->text(kLongestStudyName);
    if (!ids.insert(label.id).second) value.at("id").fail("is there twice");
    labels.push_back(std::move(label));
  }
  return labels;
}

void read_quantities(const JsonCursor& list, ResultsStudy& study) {
  for (const JsonCursor& value : list.elements(0, kMostLabels)) {
    const Quantity quantity = read_quantity(value);
    if (std::ranges::find(study.quantities, quantity.id) != study.quantities.end())
      value.at("id").fail("is there twice");
    study.quantities.push_back(quantity.id);
    study.results.quantities.declare(quantity);
  }
}

}  // namespace

ResultsStudy parse_results_study(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor value = document.cursor();
  expect_schema(value, kResultsStudy);
  value.allow_only({"schema", "name", "title", "question", "command", "quantities", "setups",
                    "methods", "factors", "runs_are_repeats"});
  ResultsStudy study;
  study.name = "results";
  if (const auto name = value.find("name")) {
    study.name = name->text(kLongestStudyName);
    if (!is_study_name(study.name))
      name->fail("expected lower-case letters, digits and '-', a letter first");
  }
  study.title = value.at("title").text(1000);
  if (study.title.empty()) value.at("title").fail("is empty");
  if (const auto question = value.find("question")) study.question = question->text();
  if (const auto command = value.find("command")) study.command = command->text();
  if (const auto list = value.find("quantities")) read_quantities(*list, study);
  if (const auto list = value.find("setups")) study.setups = read_labels(*list, false);
  if (const auto list = value.find("methods")) study.methods = read_labels(*list, false);
  if (const auto list = value.find("factors")) study.factors = read_labels(*list, true);
  study.results.are_repeats = true;
  if (const auto repeats = value.find("runs_are_repeats"))
    study.results.are_repeats = repeats->boolean();
  return study;
}

ResultsStudy read_results_study(const fs::path& folder) {
  if (!is_study(folder)) throw IoError(folder.string(), "holds no study: study.json is missing");
  const std::string head = (folder / "study.json").string();
  const std::string table = (folder / "results.csv").string();
  ResultsStudy study = parse_results_study(read_file(head), head);
  study.results.rows = parse_results_csv(read_file(table), table, study.results.quantities);
  if (study.results.rows.empty()) throw IoError(table, "has no row");
  if (const std::string unused = complete(study); !unused.empty())
    throw IoError(head, fmt::format("{}: results.csv has no row of it", unused));
  return study;
}

bool is_results_study(const fs::path& folder) {
  if (!is_study(folder)) return false;
  const fs::path path = folder / "study.json";
  const JsonDocument document = parse_json(read_file(path), path.string());
  return schema_of(document.cursor()).name == kResultsStudy;
}

}  // namespace mapproof
