#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/json/text_input.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestNote = 1000;
constexpr std::size_t kMostNotes = 100;

/// Ids that the program makes itself never begin like that.
std::string read_table_id(const JsonCursor& value) {
  const std::string text = value.text(40);
  if (!text.starts_with("table-") || text.ends_with('-') || !is_plain_id(text))
    value.fail("expected \"table-\" and small letters, digits or '-', got " + in_quotes(text));
  return text;
}

PublishedValue read_value(const JsonCursor& item) {
  std::vector<std::string_view> keys = {"mpe_m", "moe_percent", "note"};
  PublishedValue value;
  value.setting = read_setting(item, keys);
  item.allow_only(keys);
  value.mpe_m = item.at("mpe_m").number(1e-9, kFarthest_m);
  value.moe_percent = item.at("moe_percent").number(0.0, 100.0);
  if (const auto note = item.find("note")) value.note = note->text(kLongestNote);
  return value;
}

std::vector<Method> read_ordering(const JsonCursor& array) {
  std::vector<Method> methods;
  for (const JsonCursor& item : array.elements(2, 1000)) {
    const Method method = read_method(item.text(), item);
    if (std::ranges::find(methods, method) != methods.end())
      item.fail(fmt::format("{} stands twice in one ordering", info(method).name));
    methods.push_back(method);
  }
  return methods;
}

Json value_of(const PublishedValue& published) {
  Json value = Json::object();
  put_setting(value, published.setting);
  value["mpe_m"] = published.mpe_m;
  value["moe_percent"] = published.moe_percent;
  if (!published.note.empty()) value["note"] = published.note;
  return value;
}

}  // namespace

Published read_published(const JsonCursor& object) {
  object.allow_only({"source", "table", "values", "notes", "orderings"});
  Published published;
  published.source = object.at("source").text(200);
  if (published.source.empty()) object.at("source").fail("expected the name of a source");
  if (const auto table = object.find("table")) published.table = read_table_id(*table);
  for (const JsonCursor& item : object.at("values").elements(0, 1000))
    published.values.push_back(read_value(item));
  if (const auto notes = object.find("notes"))
    for (const JsonCursor& item : notes->elements(0, kMostNotes))
      published.notes.push_back(item.text(kLongestNote));
  if (const auto orderings = object.find("orderings"))
    for (const JsonCursor& item : orderings->elements(0, 1000))
      published.orderings.push_back(read_ordering(item));
  return published;
}

Json published_value(const Published& published) {
  Json value = {{"source", published.source}};
  if (!published.table.empty()) value["table"] = published.table;
  value["values"] = Json::array();
  for (const PublishedValue& item : published.values) value["values"].push_back(value_of(item));
  if (!published.notes.empty()) value["notes"] = published.notes;
  for (const std::vector<Method>& ordering : published.orderings) {
    Json names = Json::array();
    for (const Method method : ordering) names.push_back(info(method).name);
    value["orderings"].push_back(std::move(names));
  }
  return value;
}

void check_table_ids(const Experiment& experiment, const JsonCursor& document) {
  for (const SensorStudy& study : experiment.sensors)
    for (const SensorStudy& other : experiment.sensors) {
      const std::string& id = study.published.table;
      const std::string& longer = other.published.table;
      // "table-1-half" is a table that goes with "table-1".
      if (&study == &other || id.empty() || !(longer + '-').starts_with(id + '-')) continue;
      document.at("sensors")
          .at(std::string(name(other.sensor.sensor)))
          .at("published")
          .at("table")
          .fail(fmt::format("{} begins as the table of {} does, {}", in_quotes(longer),
                            name(study.sensor.sensor), in_quotes(id)));
    }
}

}  // namespace mapproof
