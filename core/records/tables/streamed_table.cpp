#include "core/records/tables/streamed_table.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestLine = 1 << 20;

/// What is wrong with one line, with its location in the file.
template <typename Read>
void at_location(const std::string& source, std::size_t line, const char* what, Read read) {
  try {
    read();
  } catch (const IoError&) {
    throw IoError(source, fmt::format("line {}", line), what);
  }
}

}  // namespace

void StreamedTable::take(std::string_view bytes, const TakeRow& take_row) {
  while (true) {
    const std::size_t end = bytes.find('\n');
    const std::string_view part = bytes.substr(0, end);
    if (pending_.size() + part.size() > kLongestLine)
      throw IoError(source_, fmt::format("line {}", line_ + 1), "is longer than 1 MiB");
    pending_ += part;
    if (end == std::string_view::npos) return;
    read_line(std::exchange(pending_, {}), take_row);
    bytes.remove_prefix(end + 1);
  }
}

void StreamedTable::end(const TakeRow& take_row) {
  if (is_cut_table(pending_)) cut_remark_ = kCutRemark;
  if (pending_.empty()) return;
  const bool is_first = line_ == 0;
  try {
    read_line(std::exchange(pending_, {}), take_row);
  } catch (const IoError&) {
    // Whoever wrote it was stopped within a line: what was whole before it counts.
    if (cut_remark_ == nullptr || is_first) throw;
    cut_remark_ = kCutOffRemark;
  }
}

void StreamedTable::read_line(std::string_view line, const TakeRow& take_row) {
  ++line_;
  if (line.empty()) return;
  std::string_view text;
  at_location(source_, line_, "is not UTF-8 text, or holds a NUL byte",
              [&] { text = checked_text(line, source_, line_); });
  if (separator_ == '\0') separator_ = TableReader::separator_in(text);
  TableReader reader(text, source_, separator_, line_);
  TableRow row;
  bool is_row = false;
  at_location(source_, line_, "its quotes are broken, or a cell goes over its end",
              [&] { is_row = reader.next(row); });
  if (is_row) take_row(row);
}

}  // namespace mapproof
