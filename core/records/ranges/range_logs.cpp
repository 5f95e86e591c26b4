#include "core/records/ranges/range_logs.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/paths.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/detections/scan_rows.hpp"
#include "core/records/ranges/range_columns.hpp"
#include "core/records/ranges/range_log_assembly.hpp"
#include "core/records/ranges/range_log_forms.hpp"
#include "core/records/ranges/range_log_g2o.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

enum class Form { kNone, kCsv, kMat, kPyfg, kG2o, kText };

bool is_ranges_csv(const fs::path& path) { return unpacked_name(path).filename() == "ranges.csv"; }

/// The form that a name suggests.
Form form_named(const fs::path& path) {
  const fs::path extension = unpacked_name(path).extension();
  if (is_ranges_csv(path)) return Form::kCsv;
  if (extension == ".mat") return Form::kMat;
  if (extension == ".pyfg") return Form::kPyfg;
  if (extension == ".g2o") return Form::kG2o;
  return text_stem(path).empty() ? Form::kNone : Form::kText;
}

bool is_pyfg(const TableRow& row) {
  return row.cells[0].starts_with("VERTEX_") || row.cells[0].starts_with("EDGE_");
}

/// Of both forms of graphs: PyFG stamps its poses, g2o does not.
bool is_g2o(const TableRow& row) {
  return names_graph_record(row) && ((row.cells[0] == "VERTEX_SE2" && row.cells.size() == 5) ||
                                     (row.cells[0] == "VERTEX_XY" && row.cells.size() == 4 &&
                                      number_in(row.cells[1]).has_value()) ||
                                     row.cells[0] == "FIX" || row.cells[0].starts_with("PARAMS_") ||
                                     row.cells[0] == "EDGE_RANGE_SE2_XY");
}

bool is_ranges_text(const TableRow& row) {
  return row.cells.size() == 4 &&
         std::ranges::all_of(row.cells, [](auto cell) { return number_in(cell).has_value(); });
}

/// A table whose header names times, landmarks and ranges.
bool is_table_of_ranges(ByteSource& source, const ColumnNames& names) {
  return first_row_is(
      source, [&](const TableRow& row) { return missing_range_columns(row, names).empty(); });
}

/// The form that the first bytes show.
Form form_seen(ByteSource& source, const ColumnNames& names = {}) {
  if (source.peek().starts_with("MATLAB")) return Form::kMat;
  refuse_other_kind(source.peek(), source.name());
  try {
    if (is_table_of_ranges(source, names)) return Form::kCsv;
    if (first_row_is(source, is_g2o, TableReader::kBlanks)) return Form::kG2o;
    if (first_row_is(source, is_pyfg, TableReader::kBlanks)) return Form::kPyfg;
    if (first_row_is(source, is_ranges_text, TableReader::kBlanks)) return Form::kText;
    return Form::kNone;
  } catch (const IoError&) {
    return Form::kNone;  // No text: its reader reports what is wrong.
  }
}

/// A table of NumPy or JSON becomes one of CSV.
Form form_of(ByteSource& source, const ColumnNames& names) {
  Form seen = form_seen(source, names);
  if (seen == Form::kNone && form_named(source.path()) == Form::kNone) {
    respell(source);
    if (is_table_of_ranges(source, names)) seen = Form::kCsv;
  }
  return seen == Form::kNone ? form_named(source.path()) : seen;
}

/// "Plaza1" of Plaza1_.mat, "plaza1" of plaza1/ranges.csv.
std::string log_name(const fs::path& path) {
  if (path.empty()) return "stream";
  const fs::path plain = unpacked_name(fs::absolute(path).lexically_normal());
  const fs::path stem = text_stem(path);
  std::string name = is_ranges_csv(path) ? plain.parent_path().filename().string()
                     : stem.empty()      ? plain.stem().string()
                                         : stem.filename().string();
  while (name.size() > 1 && name.back() == '_') name.pop_back();
  return name;
}

/// Of a table with a header: the columns that are not known by their names.
[[noreturn]] void refuse_table(const std::string& source, const std::string& header,
                               const std::vector<ColumnRole>& missing) {
  std::vector<std::string> words, options;
  for (const ColumnRole role : missing) {
    words.push_back(fmt::format("{}s", name(role)));
    options.push_back(fmt::format("{}=HEADER", name(role)));
  }
  throw IoError(source, fmt::format("its header {} names no {}: --columns {} does", header,
                                    fmt::join(words, " and no "), fmt::join(options, ",")));
}

[[noreturn]] void refuse_log(const std::string& source) {
  throw IoError(
      source,
      "holds no ranges: expected a folder with ranges.csv, or NAME.mat, NAME.pyfg, NAME.g2o, "
      "NAME_DR.txt with NAME_TD.txt");
}

/// The word of range logs for what others call a landmark.
bool names_beacons(const TableRow& row) {
  return std::ranges::any_of(
      row.cells, [](std::string_view cell) { return lower_case(trimmed(cell)) == "beacon"; });
}

}  // namespace

RangeLog read_range_log(ByteSource& source, const RangeLogOptions& options) {
  RangeLogOptions named = options;
  if (named.name.empty()) named.name = log_name(source.path());
  switch (form_of(source, options.columns)) {
    case Form::kCsv:
      return read_range_log_csv(source, named);
    case Form::kMat:
      return read_range_log_mat(source, named);
    case Form::kPyfg:
      return read_range_log_pyfg(source, named);
    case Form::kG2o:
      return assemble(gather_g2o(source, named), named);
    case Form::kText:
      return read_range_log_text(source, named);
    case Form::kNone:
      break;
  }
  std::string header;
  std::vector<ColumnRole> missing;
  first_row_is(source,
               [&](const TableRow& row) {
                 header = in_quotes(fmt::format("{}", fmt::join(row.cells, ", ")));
                 missing = missing_range_columns(row, options.columns);
                 for (const ColumnRole role : missing)
                   require_named(role, row, source.name(), options.columns);
                 return row.cells.size() > 2 &&
                        std::ranges::none_of(row.cells, [](std::string_view cell) {
                          return number_in(cell).has_value();
                        });
               })
      ? refuse_table(source.name(), header, missing)
      : refuse_log(source.name());
}

RangeLog read_range_log(const fs::path& path, const RangeLogOptions& options) {
  if (is_folder(path) && !is_range_log_folder(path)) refuse_log(path.string());
  ByteSource source(is_folder(path) ? plain_or_packed(path / "ranges.csv") : path);
  return read_range_log(source, options);
}

bool is_range_log_folder(const fs::path& folder) {
  return is_there(plain_or_packed(folder / "ranges.csv"));
}

bool is_range_log(ByteSource& source, const ColumnNames& columns) {
  const Form seen = form_seen(source, columns), named = form_named(source.path());
  if (seen == Form::kCsv)
    return named == Form::kCsv ||
           !first_row_is(
               source,
               [&](const TableRow& row) { return names_detection_columns(row, columns); }) ||
           first_row_is(source, names_beacons);
  if (seen == Form::kText || seen == Form::kNone)
    return named != Form::kNone && named != Form::kCsv;
  return true;
}

}  // namespace mapproof
