#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "core/base/packed_file.hpp"
#include "core/records/table_reader.hpp"

namespace mapproof {

/// The rows of a table file of any length, gzip'ed or not, as TableReader has them; a few megabytes
/// of it are held at a time.
class TableStream {
 public:
  explicit TableStream(const std::filesystem::path& path);

  /// @return Whether there was a row. @throws IoError with the line for what is no text, for broken
  ///         quotes, or a row of more than 16 MB.
  bool next(TableRow& row);

  /// After the last row: it has no line end, see kCutRemark.
  bool is_cut() const { return is_cut_; }

  const std::string& source() const { return source_; }
  /// Bytes that the whole text will have, judged by what was read so far.
  double expected_size() const { return file_.expected_size(); }

 private:
  bool read_rows();

  std::string source_;
  PackedFile file_;
  std::string bytes_;      ///< Whole rows, then the start of the next one.
  std::size_t whole_ = 0;  ///< Bytes of them that are whole rows.
  std::size_t lines_ = 0;  ///< Before them.
  bool is_over_ = false;
  bool is_cut_ = false;
  char separator_ = '\0';  ///< Not known before the first row.
  std::optional<TableReader> reader_;
};

}  // namespace mapproof
