#include <algorithm>
#include <charconv>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/base/text/csv.hpp"
#include "core/base/text/words.hpp"
#include "core/json/json_document.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/tables/column_names.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/time_text.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::json;

/// Key and cell of a row.
using Members = std::vector<std::pair<std::string, std::string>>;

bool is_scalar(const Json& value) { return value.is_primitive(); }

std::string cell_of(const Json& value) {
  if (value.is_null()) return {};
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  return value.is_string() ? csv_field(value.get<std::string>()) : value.dump();
}

bool lists_objects(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::ranges::all_of(value, [](const Json& one) { return one.is_object(); });
}

/// Gathers rows whose keys may differ.
class JsonTable {
 public:
  explicit JsonTable(const std::string& source) : source_(source) {}

  /// A row; of an object with a list of objects, such as the detections of a scan, one for each.
  void add(const Json& object) {
    Members members;
    const Json* list = flatten(object, "", members);
    if (list == nullptr) return add_row(members);
    for (const Json& one : *list) {
      Members row = members;
      if (const Json* nested = flatten(one, "", row); nested != nullptr && !nested->empty())
        throw IoError(source_, "its lists of objects are nested: a table has rows alone");
      add_row(row);
    }
  }

  void add_row(const Members& members) {
    if (rows_.size() > 50'000'000) throw IoError(source_, "more than 50000000 rows");
    auto& row = rows_.emplace_back();
    for (const auto& [key, cell] : members) row.emplace_back(column(key), cell);
  }

  /// Steps and times come first, so that a table of landmarks and steps is recognised.
  std::string csv() const {
    std::vector<std::size_t> order(keys_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_partition(
        order, [&](std::size_t i) { return names_steps(keys_[i]) || keys_[i] == "index"; });
    std::string text;
    for (const std::size_t i : order) text += (text.empty() ? "" : ",") + csv_field(keys_[i]);
    text += '\n';
    std::vector<const std::string*> cells(keys_.size());
    for (const auto& row : rows_) {
      std::ranges::fill(cells, nullptr);
      for (const auto& [i, cell] : row) cells[i] = &cell;
      for (std::size_t k = 0; k < order.size(); ++k) {
        if (cells[order[k]] != nullptr) text += *cells[order[k]];
        text += k + 1 == order.size() ? '\n' : ',';
      }
    }
    return text;
  }

  bool is_empty() const { return rows_.empty(); }

 private:
  std::size_t column(const std::string& key) {
    const auto [found, is_new] = index_.emplace(key, keys_.size());
    if (is_new) keys_.push_back(key);
    if (keys_.size() > kMostLandmarks + 16) throw IoError(source_, "its rows have too many keys");
    return found->second;
  }

  /// Appends the scalars of an object, "pose.x" of nested ones. @return Its list of objects.
  const Json* flatten(const Json& object, const std::string& prefix, Members& members) const {
    const Json* list = nullptr;
    for (const auto& [key, value] : object.items()) {
      const std::string name = prefix + key;
      if (is_scalar(value)) {
        members.emplace_back(name, cell_of(value));
      } else if (value.is_array() && value.size() == 1 && is_scalar(value[0])) {
        members.emplace_back(name, cell_of(value[0]));  // As the ID of a tag that ROS detected.
      } else if (lists_objects(value) || (value.is_array() && value.empty())) {
        if (list != nullptr && lists_objects(*list) && lists_objects(value))
          throw IoError(source_, "its rows hold several lists of objects: " + printable(name));
        if (list == nullptr || lists_objects(value)) list = &value;
      } else if (const Json* nested = flatten(value, name + ".", members); nested != nullptr) {
        list = nested;
      }
    }
    return list;
  }

  const std::string& source_;
  std::vector<std::string> keys_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::vector<std::vector<std::pair<std::size_t, std::string>>> rows_;
};

/// Rows that are lists of scalars.
std::string matrix_csv(const Json& rows, const std::string& source) {
  std::string text;
  for (const Json& row : rows) {
    if (!row.is_array() || row.empty() || !std::ranges::all_of(row, is_scalar))
      throw IoError(source, "a list of lists, of which one is not a row of numbers");
    std::string line;
    for (const Json& cell : row) line += (&cell == &row.front() ? "" : ",") + cell_of(cell);
    text += line + "\n";
  }
  return text;
}

bool are_all(const Json& object, bool (*is)(const Json&)) {
  return !object.empty() && std::ranges::all_of(object, is);
}

bool lists_scalars(const Json& value) {
  return value.is_array() && std::ranges::all_of(value, is_scalar);
}

bool maps_scalars(const Json& value) {
  return value.is_object() && std::ranges::all_of(value, is_scalar);
}

/// {"columns": [...], "data": [[...], ...]}, with an index or without, as pandas splits tables.
std::string split_csv(const Json& object, const std::string& source) {
  Json rows = Json::array({object.at("columns")});
  for (const Json& row : object.at("data")) rows.push_back(row);
  if (const auto index = object.find("index"); index != object.end() && index->is_array())
    for (std::size_t i = 0; i < rows.size() && rows[i].is_array(); ++i)
      rows[i].insert(rows[i].begin(), i == 0                  ? Json("")
                                      : i - 1 < index->size() ? (*index)[i - 1]
                                                              : Json());
  return matrix_csv(rows, source);
}

/// {"time": [0, 1], "range": [2, 3]}.
void add_columns(const Json& object, JsonTable& table, const std::string& source) {
  const std::size_t rows = object.front().size();
  for (const auto& [key, column] : object.items())
    if (column.size() != rows)
      throw IoError(source, fmt::format("its column {} has {} rows where the first has {}",
                                        printable(key), column.size(), rows));
  for (std::size_t i = 0; i < rows; ++i) {
    Members members;
    for (const auto& [key, column] : object.items()) members.emplace_back(key, cell_of(column[i]));
    table.add_row(members);
  }
}

/// Whether all keys are numbers or times.
bool are_keys_steps(const Json& object) {
  for (const auto& [key, value] : object.items())
    if (!time_in(key)) return false;
  return true;
}

/// Whether {"0": {"door": 0.5}, ...} holds rows with their names, as orient="index" of pandas; else
/// it holds columns.
bool are_rows(const Json& object) {
  return are_keys_steps(object) && !object.front().empty() && !are_keys_steps(object.front());
}

/// The order of rows by their names: numbers by size, others as texts.
std::pair<long long, std::string> row_order(const std::string& row) {
  long long number = 0;
  std::from_chars(row.data(), row.data() + row.size(), number);
  return {number, row};
}

/// {"0": {"door": 0.5}, ...}: rows with their names.
void add_named_rows(const Json& object, JsonTable& table) {
  std::map<std::pair<long long, std::string>, const Json*> rows;
  for (const auto& [key, row] : object.items()) rows[row_order(key)] = &row;
  for (const auto& [order, row] : rows) {
    Members members = {{"index", csv_field(order.second)}};
    for (const auto& [column, value] : row->items()) members.emplace_back(column, cell_of(value));
    table.add_row(members);
  }
}

/// Rows in the "data" of a table with its fields, as orient="table" of pandas.
bool is_data_with_fields(const Json& root) {
  const auto schema = root.find("schema");
  return schema != root.end() && schema->is_object() && schema->contains("fields") &&
         root.contains("data") && lists_objects(root.at("data"));
}

/// {"time": {"0": 0, "1": 1}, ...}: columns with the names of rows.
void add_indexed(const Json& object, JsonTable& table) {
  std::map<std::pair<long long, std::string>, Members> rows;
  for (const auto& [key, column] : object.items())
    for (const auto& [row, value] : column.items()) {
      Members& members = rows[row_order(row)];
      if (members.empty()) members.emplace_back("index", csv_field(row));
      members.emplace_back(key, cell_of(value));
    }
  for (const auto& [row, members] : rows) table.add_row(members);
}

std::string lines_csv(std::string_view text, const std::string& source) {
  JsonTable table(source);
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view one = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (one.empty()) continue;
    const Json object = parse_json(one, fmt::format("{}: line {}", source, line)).tree();
    if (!object.is_object())
      throw IoError(source, fmt::format("line {}", line), "is not a JSON object");
    table.add(object);
  }
  if (table.is_empty()) throw IoError(source, "holds no rows");
  return table.csv();
}

}  // namespace

bool holds_json_lines(std::string_view bytes) {
  const std::string_view text = trimmed(bytes, kWhiteSpace);
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return false;
  const std::string_view first = trimmed(text.substr(0, end));
  const std::size_t next = text.find_first_not_of(kWhiteSpace, end);
  return first.starts_with('{') && first.ends_with('}') && next != std::string_view::npos &&
         text[next] == '{';
}

bool holds_json_rows(ByteSource& source) {
  constexpr std::size_t kSchemaStart = 60;  // A table's schema begins with its fields.
  const std::string_view start = source.peek();
  const std::size_t first = start.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first == std::string_view::npos) return false;
  if (start[first] == '{') {
    const std::size_t schema = start.find("\"schema\"");
    return schema == std::string_view::npos ||
           start.substr(schema, kSchemaStart).find("\"fields\"") != std::string_view::npos;
  }
  const std::size_t next = start.find_first_not_of(kWhiteSpace, first + 1);
  return start[first] == '[' && next != std::string_view::npos &&
         (start[next] == '{' || start[next] == '[');
}

std::string json_rows_csv(std::string_view text, const std::string& source) {
  if (holds_json_lines(text)) return lines_csv(text, source);
  const Json root = parse_json(text, source).tree();
  JsonTable table(source);
  if (root.is_array()) {
    if (!lists_objects(root)) return matrix_csv(root, source);
    for (const Json& row : root) table.add(row);
  } else if (is_data_with_fields(root)) {
    for (const Json& row : root.at("data")) table.add(row);
  } else if (root.contains("columns") && root.contains("data")) {
    return split_csv(root, source);
  } else if (are_all(root, lists_scalars)) {
    add_columns(root, table, source);
  } else if (are_all(root, maps_scalars)) {
    are_rows(root) ? add_named_rows(root, table) : add_indexed(root, table);
  } else if (!root.empty()) {
    table.add(root);
  }
  if (table.is_empty())
    throw IoError(source, "does not state what it is (no \"schema\"), and holds no rows");
  return table.csv();
}

}  // namespace mapproof
