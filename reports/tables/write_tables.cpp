#include "reports/tables/write_tables.hpp"

#include <algorithm>

#include "core/base/files.hpp"

namespace mapproof {

std::string joined(const TableLines& lines) {
  std::string text = lines.head;
  for (const std::string& row : lines.rows) text += row;
  return text + lines.tail;
}

std::vector<std::string> write_tables(const Report& report, const std::filesystem::path& folder) {
  check(report);  // The ids become file names.
  std::vector<std::string> written;
  const auto write = [&](const std::string& file, const std::string& text) {
    write_file(folder / file, text);
    written.push_back(file);
  };
  for (const Table* table : tables(report)) {
    write(table->id + ".csv", table_csv(*table));
    write(table->id + ".tex", table_latex(*table));
    write(table->id + ".md", table_markdown(*table));
  }
  std::ranges::sort(written);
  return written;
}

}  // namespace mapproof
