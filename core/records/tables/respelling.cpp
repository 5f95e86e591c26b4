#include "core/records/tables/respelling.hpp"

#include <zip.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/text/csv.hpp"
#include "core/json/text_input.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/tables/npy.hpp"
#include "core/records/tables/number_rows.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kNpy = "\x93NUMPY";
constexpr std::size_t kLargestArray = std::size_t{1} << 31;

/// A table's text as a source.
ByteSource source_of(std::string name, std::string text) {
  const auto bytes = std::make_shared<const std::string>(std::move(text));
  return {std::move(name), [bytes, at = std::size_t{0}](std::span<char> to) mutable {
            const std::size_t count = std::min(to.size(), bytes->size() - at);
            std::copy_n(bytes->data() + at, count, to.begin());
            at += count;
            return count;
          }};
}

bool is_graph(const TableRow& row) {
  return row.cells.size() > 2 &&
         (row.cells[0].starts_with("VERTEX") || row.cells[0].starts_with("EDGE_") ||
          row.cells[0] == "BR" || row.cells[0] == "LANDMARK");
}

void append_rows(std::string& text, const NpyArray& array, const std::string& source) {
  if (array.shape().size() != 2)
    throw IoError(source, fmt::format("a NumPy array of shape ({}); a table has two dimensions",
                                      fmt::join(array.shape(), ", ")));
  for (std::size_t row = 0; row < array.shape()[0]; ++row)
    for (std::size_t column = 0; column < array.shape()[1]; ++column) {
      array.append(text, row, column);
      text += column + 1 == array.shape()[1] ? '\n' : ',';
    }
}

/// An archive of arrays.
class Archive {
 public:
  Archive(std::string_view bytes, const std::string& source) : source_(source) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* buffer = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (buffer != nullptr) archive_ = zip_open_from_source(buffer, ZIP_RDONLY, &error);
    const std::string what = zip_error_strerror(&error);
    zip_error_fini(&error);
    if (archive_ != nullptr) return;
    zip_source_free(buffer);
    throw IoError(source_, "the archive of NumPy arrays is damaged: " + what);
  }
  ~Archive() { zip_discard(archive_); }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// Names without ".npy", and bytes.
  std::vector<std::pair<std::string, std::string>> arrays() {
    std::vector<std::pair<std::string, std::string>> arrays;
    std::size_t total = 0;
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive_, 0); ++i) {
      zip_stat_t facts;
      if (zip_stat_index(archive_, static_cast<zip_uint64_t>(i), 0, &facts) != 0) continue;
      std::string name = facts.name;
      if (!name.ends_with(".npy")) continue;
      total += facts.size;
      if (facts.size > kLargestArray || total > kLargestArray)
        throw IoError(source_, "its arrays unpack to more than 2 GiB");
      arrays.emplace_back(name.substr(0, name.size() - 4),
                          entry(static_cast<zip_uint64_t>(i), facts.size));
    }
    return arrays;
  }

 private:
  std::string entry(zip_uint64_t index, zip_uint64_t size) {
    std::string bytes(size, '\0');
    zip_file_t* file = zip_fopen_index(archive_, index, 0);
    const bool is_read =
        file != nullptr && zip_fread(file, bytes.data(), size) == static_cast<zip_int64_t>(size);
    if (file != nullptr) zip_fclose(file);
    if (!is_read) throw IoError(source_, "the archive of NumPy arrays is damaged");
    return bytes;
  }

  const std::string& source_;
  zip_t* archive_ = nullptr;
};

struct NamedArray {
  std::string name;
  NpyArray array;
};

/// Arrays of one dimension and one length: the columns of a table.
std::string columns_csv(const std::vector<NamedArray>& arrays) {
  std::string text;
  for (const NamedArray& one : arrays) text += (text.empty() ? "" : ",") + csv_field(one.name);
  text += '\n';
  for (std::size_t row = 0; row < arrays[0].array.shape()[0]; ++row)
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      arrays[i].array.append(text, row, 0);
      text += i + 1 == arrays.size() ? '\n' : ',';
    }
  return text;
}

/// What an edge of a graph measures of a landmark; an empty tag: nothing.
struct GraphEdge {
  std::string_view tag;
  std::size_t cells;
  bool is_position;  ///< Else a bearing, and perhaps a range.
  bool has_range;
};

constexpr GraphEdge kGraphEdges[] = {{"EDGE_SE2_XY", 5, true, true},
                                     {"LANDMARK", 5, true, true},
                                     {"BR", 5, false, true},
                                     {"EDGE_BEARING_SE2_XY", 4, false, false}};

double graph_number(const TableRow& row, std::size_t cell, const std::string& source) {
  const std::optional<double> value = number_in(row.cells[cell]);
  if (!value || !std::isfinite(*value))
    throw IoError(source, fmt::format("line {}", row.line), number_problem(row.cells[cell]));
  return *value;
}

}  // namespace

std::string npy_csv(std::string_view bytes, const std::string& source) {
  std::string text;
  append_rows(text, NpyArray(bytes, source), source);
  return text;
}

std::string npz_csv(std::string_view bytes, const std::string& source) {
  Archive archive(bytes, source);
  const auto files = archive.arrays();
  std::vector<NamedArray> arrays;
  for (const auto& [name, array] : files)
    arrays.push_back({name, NpyArray(array, fmt::format("{}: {}", source, printable(name)))});
  const auto is_table = [](const NamedArray& one) { return one.array.shape().size() == 2; };
  const auto tables = std::ranges::count_if(arrays, is_table);
  if (tables == 1) {
    std::string text;
    append_rows(text, std::ranges::find_if(arrays, is_table)->array, source);
    return text;
  }
  const bool are_columns =
      !arrays.empty() && std::ranges::all_of(arrays, [&](const NamedArray& one) {
        return one.array.shape().size() == 1 && one.array.shape() == arrays[0].array.shape();
      });
  if (are_columns) return columns_csv(arrays);
  std::vector<std::string> names;
  for (const NamedArray& one : arrays) names.push_back(printable(one.name));
  throw IoError(source, fmt::format("holds the arrays {}; one array of two dimensions is read, or "
                                    "columns of one length: numpy.save(\"table.npy\", array)",
                                    fmt::join(names, ", ")));
}

std::string graph_csv(std::string_view text, const std::string& source) {
  TableReader reader(text, source, TableReader::kBlanks);
  TableRow row;
  std::string csv = "step,landmark,range,bearing\n";
  std::size_t edges = 0;
  while (reader.next(row)) {
    const auto* edge = std::ranges::find(kGraphEdges, row.cells[0], &GraphEdge::tag);
    if (edge == std::end(kGraphEdges)) continue;
    if (row.cells.size() < edge->cells)
      throw IoError(source, fmt::format("line {}", row.line), "the edge is cut off");
    const double a = graph_number(row, 3, source);
    const double b = edge->has_range ? graph_number(row, 4, source) : 0.0;
    const double range = edge->is_position ? std::hypot(a, b) : b;
    csv += fmt::format("{},{},{},{}\n", row.cells[1], csv_field(std::string(row.cells[2])),
                       edge->has_range ? fmt::format("{}", range) : "",
                       edge->is_position ? std::atan2(b, a) : a);
    ++edges;
  }
  if (edges == 0)
    throw IoError(source,
                  "is a graph without edges of bearing and range (EDGE_SE2_XY, "
                  "EDGE_BEARING_SE2_XY, BR, LANDMARK); `mapproof slam` reads edges of ranges");
  return csv;
}

void respell(ByteSource& source) {
  const std::string name = source.name();
  const std::string called = name + ", read as a table";
  const std::string_view start = source.peek();
  if (start.starts_with(kNpy)) {
    const std::string bytes = source.rest();
    source = source_of(called, npy_csv(bytes, name));
  } else if (is_npz(start)) {
    const std::string bytes = source.rest();
    source = source_of(called, npz_csv(bytes, name));
  } else if (holds_json_rows(source)) {
    const std::string bytes = source.rest();
    source = source_of(called, json_rows_csv(checked_text(bytes, name), name));
  } else {
    refuse_other_kind(start, name);
    if (start.starts_with("VERTEX") || start.starts_with("EDGE_") || start.starts_with("BR ") ||
        start.starts_with("LANDMARK ")) {
      const bool is_known = first_row_is(source, is_graph, TableReader::kBlanks);
      if (!is_known) return;
      const std::string bytes = source.rest();
      source = source_of(called, graph_csv(checked_text(bytes, name), name));
    }
  }
}

}  // namespace mapproof
