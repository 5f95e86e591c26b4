#include "core/records/tables/table_stream.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/windows_1252.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;

bool is_comment(std::string_view line) {
  const std::string_view content = trimmed(line);
  return !content.empty() && content.front() == '#';
}

}  // namespace

std::size_t RowEnds::in(std::string_view bytes) {
  if (!has_quotes_) {
    has_quotes_ = bytes.find('"', searched_) != std::string_view::npos;
    if (!has_quotes_) {
      const auto* end = static_cast<const char*>(
          ::memrchr(bytes.data() + searched_, '\n', bytes.size() - searched_));
      searched_ = bytes.size();
      if (end != nullptr) whole_ = static_cast<std::size_t>(end - bytes.data()) + 1;
      return whole_;
    }
    line_ = whole_;  // The lines before hold no quotes.
  }
  for (;;) {
    const std::size_t end = bytes.find('\n', std::max(line_, searched_));
    searched_ = bytes.size();
    if (end == std::string_view::npos) return whole_;
    const std::string_view line = bytes.substr(line_, end - line_);
    if (is_quoted_ || !is_comment(line))
      is_quoted_ = is_quoted_ != (std::ranges::count(line, '"') % 2 == 1);
    line_ = searched_ = end + 1;
    if (!is_quoted_) whole_ = line_;
  }
}

namespace {

/// Bytes up to the last end of a row.
std::size_t whole_rows(std::string_view bytes) { return RowEnds().in(bytes); }

}  // namespace

bool first_row_is(ByteSource& source, const std::function<bool(const TableRow& row)>& sort,
                  std::optional<char> separator) {
  for (std::size_t count = ByteSource::kPeek;; count *= 4) {
    const std::string_view start = source.peek(count);
    const bool is_all = start.size() < count;
    const std::size_t whole = is_all ? start.size() : whole_rows(start);
    if (whole > 0 || is_all) {
      const std::string decoded =
          is_windows_1252(start) ? from_windows_1252(start.substr(0, whole)) : std::string();
      const std::string_view text =
          checked_text(decoded.empty() ? start.substr(0, whole) : decoded, source.name());
      TableReader reader(text, source.name(), separator.value_or(TableReader::separator_in(text)));
      if (TableRow row; reader.next(row)) return sort(row);
    }
    if (is_all || start.size() > TableStream::kLongestRow) return false;
  }
}

std::vector<std::string> first_row(ByteSource& source) {
  std::vector<std::string> cells;
  first_row_is(source, [&](const TableRow& row) {
    cells.assign(row.cells.begin(), row.cells.end());
    return true;
  });
  return cells;
}

/// The next rows to the front of bytes_; false: there are no more.
bool TableStream::read_rows() {
  lines_ += static_cast<std::size_t>(std::count(bytes_.begin(), bytes_.begin() + whole_, '\n'));
  bytes_.erase(0, whole_);
  whole_ = 0;
  RowEnds ends;
  while (whole_ == 0 && !is_over_) {
    is_over_ = !source_.append(bytes_, kBlock);
    whole_ = is_over_ ? bytes_.size() : ends.in(bytes_);
    if (whole_ == 0 && bytes_.size() > longest_row_)
      throw IoError(
          source(), fmt::format("line {}", lines_ + 1),
          fmt::format("a row of more than {} MB: do its quotes end?", longest_row_ >> 20));
  }
  if (is_over_) is_cut_ = is_cut_table(bytes_);
  if (whole_ == 0) {
    if (lines_ == 0) throw IoError(source(), "is empty");
    return false;
  }
  const std::string_view text =
      checked_text(std::string_view(bytes_).substr(0, whole_), source(), lines_ + 1);
  if (separator_ == '\0') separator_ = TableReader::separator_in(text);
  had_decimal_commas_ = has_decimal_commas();
  reader_.emplace(text, source(), separator_, lines_ + 1);
  return true;
}

bool TableStream::next(TableRow& row) {
  while (!reader_ || !reader_->next(row)) {
    if (!read_rows()) return false;
  }
  return true;
}

bool TableStream::next_numbers(NumberRow& row) {
  while (!reader_ || reader_->is_over()) {
    if (!read_rows()) return false;
  }
  return reader_->next_numbers(row);
}

}  // namespace mapproof
