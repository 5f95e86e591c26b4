#include "core/base/files/byte_source.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/text/utf8.hpp"
#include "core/base/text/windows_1252.hpp"

namespace mapproof {
namespace {

// Bytes of one call of read_, which begin small, so that a small input takes a small buffer.
constexpr std::size_t kFirstBlock = std::size_t{1} << 12;
constexpr std::size_t kPackedBlock = std::size_t{1} << 17;
constexpr std::size_t kBlock = std::size_t{1} << 20;
constexpr std::size_t kMostGuessed = std::size_t{1} << 26;

/// Bytes from the file's offset to its end; empty if only reading can find that out.
std::optional<std::size_t> bytes_left(const Descriptor& file) {
  struct stat facts {};
  if (::fstat(file.get(), &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
  const off_t at = ::lseek(file.get(), 0, SEEK_CUR);
  if (at < 0 || facts.st_size <= at) return std::nullopt;  // Files of /proc report a size of 0.
  return static_cast<std::size_t>(facts.st_size - at);
}

}  // namespace

ByteSource::ByteSource(const std::filesystem::path& path)
    : name_(input_name(path)), unpacker_(name_) {
  if (!handed_in(path)) path_ = path;
  const auto file = std::make_shared<Descriptor>(open_input(path));
  size_ = bytes_left(*file);
  read_ = [file, name = name_](std::span<char> to) { return read_some(*file, to, name); };
}

ByteSource::ByteSource(std::string name, ReadBytes read, std::string original)
    : name_(std::move(name)),
      read_(std::move(read)),
      original_(std::move(original)),
      unpacker_(name_) {}

/// Bytes as the text that they are; decides what it is at the first character beyond ASCII.
std::string ByteSource::decoded(std::string bytes) {
  if (text_ == Text::kAscii) {
    const std::size_t ascii = ascii_length(bytes);
    if (ascii == bytes.size()) return bytes;
    constexpr std::size_t kLongestCharacter = 4;
    while (bytes.size() < ascii + kLongestCharacter &&
           fill_unpacked(bytes, ascii + kLongestCharacter - bytes.size()) > 0) {
    }
    std::string_view character = std::string_view(bytes).substr(ascii);
    text_ = take_code_point(character) ? Text::kUtf8 : Text::kWindows1252;
  }
  return text_ == Text::kWindows1252 ? from_windows_1252(bytes) : bytes;
}

void ByteSource::take_text() {
  if (text_ != Text::kBytes) return;
  text_ = Text::kAscii;
  std::string start;
  for (const std::string& block : std::exchange(ahead_, {})) start += block;
  start.erase(0, std::exchange(at_, 0));
  if (!start.empty()) ahead_.push_back(decoded(std::move(start)));
}

std::string ByteSource::form() const {
  std::string form = original_;
  for (const std::string_view part :
       {unpacker_.packing(), std::string_view(text_ == Text::kWindows1252 ? "Windows-1252" : "")})
    if (!part.empty()) form += (form.empty() ? "" : ", ") + std::string(part);
  return form;
}

/// Appends `count` bytes behind the peeked ones; fewer only at the end.
std::size_t ByteSource::fill(std::string& bytes, std::size_t count) {
  if (text_ == Text::kBytes || (text_ == Text::kUtf8 && decoded_.empty()))
    return fill_unpacked(bytes, count);
  const std::size_t before = bytes.size();
  for (std::size_t filled = 0; filled < count; filled = bytes.size() - before) {
    if (decoded_.empty()) {
      std::string block;
      if (fill_unpacked(block, count - filled) == 0) break;
      decoded_ = decoded(std::move(block));
    }
    const std::size_t part = std::min(decoded_.size(), count - filled);
    bytes.append(decoded_, 0, part);
    decoded_.erase(0, part);
  }
  return bytes.size() - before;
}

/// Appends `count` bytes that follow those read so far; fewer only at the end.
std::size_t ByteSource::fill_unpacked(std::string& bytes, std::size_t count) {
  const std::size_t before = bytes.size();
  std::string block;
  for (std::size_t filled = 0; filled < count; filled = bytes.size() - before) {
    if (unpacker_.is_passing()) return filled + fill_plain(bytes, count - filled);
    if (unpacker_.drain(bytes, count - filled) == count - filled) break;
    if (is_over_) {
      if (!unpacker_.is_cut()) break;
      throw IoError(name_, unpacker_.packing() == "UTF-16"
                               ? std::string("is UTF-16, and cut off within a character")
                               : fmt::format("the {}'ed file is cut off", unpacker_.packing()));
    }
    block.resize(std::min(next_block(), kPackedBlock));
    const std::size_t got = read_(block);
    block_ = got;
    is_over_ = got == 0;
    if (is_over_)
      unpacker_.end();
    else
      unpacker_.feed(std::string_view(block).substr(0, got));
  }
  return bytes.size() - before;
}

/// Bytes of the next call of read_: twice as many as the last one gave.
std::size_t ByteSource::next_block() const { return std::clamp(2 * block_, kFirstBlock, kBlock); }

/// The same for bytes that need no unpacking: reads into `bytes` itself.
std::size_t ByteSource::fill_plain(std::string& bytes, std::size_t count) {
  const std::size_t before = bytes.size();
  std::size_t filled = 0;
  while (filled < count && !is_over_) {
    const std::size_t from = filled, end = std::min(count, from + next_block());
    bytes.resize(before + end);
    while (filled < end && !is_over_) {
      const std::size_t got = read_(std::span(bytes).subspan(before + filled));
      is_over_ = got == 0;
      filled += got;
    }
    bytes.resize(before + filled);
    block_ = filled - from;
  }
  return filled;
}

std::size_t ByteSource::ahead() const {
  std::size_t bytes = 0;
  for (const std::string& block : ahead_) bytes += block.size();
  return bytes - at_;
}

std::string_view ByteSource::peek(std::size_t count) {
  if (ahead_.empty()) ahead_.emplace_back();
  std::string& first = ahead_.front();
  first.erase(0, std::exchange(at_, 0));
  while (first.size() < count && ahead_.size() > 1) {
    first += ahead_[1];
    ahead_.erase(ahead_.begin() + 1);
  }
  if (first.size() < count) fill(first, count - first.size());
  return std::string_view(first).substr(0, count);
}

bool ByteSource::append(std::string& bytes, std::size_t count) {
  const std::size_t before = bytes.size();
  while (!ahead_.empty() && bytes.size() - before < count) {
    const std::string& first = ahead_.front();
    const std::size_t part = std::min(first.size() - at_, count - (bytes.size() - before));
    bytes.append(first, at_, part);
    at_ += part;
    if (at_ < first.size()) break;
    ahead_.pop_front();
    at_ = 0;
  }
  if (const std::size_t got = bytes.size() - before; got < count) fill(bytes, count - got);
  taken_ += bytes.size() - before;
  return bytes.size() > before;
}

std::string ByteSource::rest(std::size_t limit) {
  std::string bytes;
  if (ahead_.size() == 1 && at_ == 0) {
    bytes = std::move(ahead_.front());
    ahead_.clear();
    taken_ += bytes.size();
  }
  const double expected = expected_size().value_or(0.0) - static_cast<double>(taken_);
  const double wanted = std::max(expected, static_cast<double>(ahead()));
  // Of packed input the size is a guess, which must not cost memory that is not needed.
  if (wanted > 0.0 &&
      wanted <= static_cast<double>(unpacker_.packing().empty() ? limit : kMostGuessed))
    bytes.reserve(bytes.size() + static_cast<std::size_t>(wanted) +
                  std::min(static_cast<std::size_t>(wanted), kBlock));
  do {
    if (bytes.size() > limit) throw IoError(name_, fmt::format("is larger than {} bytes", limit));
  } while (append(bytes, kBlock));
  return bytes;
}

bool ByteSource::holds_more_than(std::size_t count) {
  peek();  // Then the unpacker knows whether the input is packed.
  if (size_ && unpacker_.packing().empty()) return *size_ > taken_ && *size_ - taken_ > count;
  std::size_t bytes = ahead();
  while (bytes <= count) {
    std::string block;
    if (fill(block, kBlock) == 0) break;
    bytes += block.size();
    ahead_.push_back(std::move(block));
  }
  return bytes > count;
}

std::optional<double> ByteSource::expected_size() const {
  if (!size_) return std::nullopt;
  return static_cast<double>(*size_) * unpacker_.ratio();
}

std::string read_input(const std::filesystem::path& path, std::size_t limit) {
  return ByteSource(path).rest(limit);
}

}  // namespace mapproof
