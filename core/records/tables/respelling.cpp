#include "core/records/tables/respelling.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/text/csv.hpp"
#include "core/json/text_input.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/tables/npy.hpp"
#include "core/records/tables/number_rows.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kNpy = "\x93NUMPY";

/// A table's text as a source. @param original  What it was: "NumPy .npy".
ByteSource source_of(std::string name, std::string text, std::string original) {
  const auto bytes = std::make_shared<const std::string>(std::move(text));
  return {std::move(name),
          [bytes, at = std::size_t{0}](std::span<char> to) mutable {
            const std::size_t count = std::min(to.size(), bytes->size() - at);
            std::copy_n(bytes->data() + at, count, to.begin());
            at += count;
            return count;
          },
          std::move(original)};
}

bool is_graph(const TableRow& row) {
  return row.cells.size() > 2 &&
         (row.cells[0].starts_with("VERTEX") || row.cells[0].starts_with("EDGE_") ||
          row.cells[0] == "BR" || row.cells[0] == "LANDMARK");
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

std::string graph_csv(std::string_view text, const std::string& source) {
  TableReader reader(text, source, TableReader::kBlanks);
  TableRow row;
  std::string csv = "step,landmark,bearing,range\n", bearings = "step,landmark,bearing\n";
  std::size_t edges = 0;
  bool has_range = false;
  while (reader.next(row)) {
    const auto* edge = std::ranges::find(kGraphEdges, row.cells[0], &GraphEdge::tag);
    if (edge == std::end(kGraphEdges)) continue;
    if (row.cells.size() < edge->cells)
      throw IoError(source, fmt::format("line {}", row.line), "the edge is cut off");
    const double a = graph_number(row, 3, source);
    const double b = edge->has_range ? graph_number(row, 4, source) : 0.0;
    const double range = edge->is_position ? std::hypot(a, b) : b;
    has_range = has_range || edge->has_range;
    const std::string seen =
        fmt::format("{},{},{}", row.cells[1], csv_field(std::string(row.cells[2])),
                    edge->is_position ? std::atan2(b, a) : a);
    csv += fmt::format("{},{}\n", seen, edge->has_range ? fmt::format("{}", range) : "");
    bearings += seen + "\n";
    ++edges;
  }
  if (edges == 0)
    throw IoError(source,
                  "is a graph without edges of bearing and range (EDGE_SE2_XY, "
                  "EDGE_BEARING_SE2_XY, BR, LANDMARK); `mapproof slam` reads edges of ranges");
  // A column of ranges, all of them missing, would be taken for what the sensor measures.
  return has_range ? csv : bearings;
}

void respell(ByteSource& source) {
  const std::string name = source.name();
  const std::string called = name + ", read as a table";
  const std::string_view start = source.peek();
  if (start.starts_with(kNpy)) {
    const std::string bytes = source.rest();
    source = source_of(called, npy_csv(bytes, name), "NumPy .npy");
  } else if (is_npz(start)) {
    const std::string bytes = source.rest();
    source = source_of(called, npz_csv(bytes, name), "NumPy .npz");
  } else if (holds_json_rows(source)) {
    const std::string bytes = source.rest();
    source = source_of(called, json_rows_csv(checked_text(bytes, name), name),
                       holds_json_lines(bytes) ? "JSON lines" : "JSON");
  } else {
    refuse_other_kind(start, name);
    const bool may_be_graph = start.starts_with("VERTEX") || start.starts_with("EDGE_") ||
                              start.starts_with("BR ") || start.starts_with("LANDMARK ");
    if (!is_json(source)) source.take_text();
    if (may_be_graph) {
      const bool is_known = first_row_is(source, is_graph, TableReader::kBlanks);
      if (!is_known) return;
      const std::string bytes = source.rest();
      source = source_of(called, graph_csv(checked_text(bytes, name), name), "a graph of g2o");
    }
  }
}

void mark_columns(ByteSource& table, ColumnNames& columns) {
  respell(table);
  if (columns.empty()) return;
  const std::vector<std::string> cells = first_row(table);
  const ColumnNames found =
      columns_in(std::vector<std::string_view>(cells.begin(), cells.end()), columns);
  for (NamedColumn& column : columns)
    if (std::ranges::find(found, column) != found.end()) column.is_elsewhere = true;
}

void mark_columns_of_file(const std::string& path, ColumnNames& columns) {
  if (columns.empty() || is_folder(path) || handed_in(path)) return;
  ByteSource source(path);
  mark_columns(source, columns);
}

void require_columns(ByteSource& table, const ColumnNames& columns) {
  if (std::ranges::all_of(columns, &NamedColumn::is_elsewhere)) return;
  respell(table);
  if (is_json(table)) return;
  const std::vector<std::string> cells = first_row(table);
  require_columns(std::vector<std::string_view>(cells.begin(), cells.end()), columns, table.name());
}

}  // namespace mapproof
