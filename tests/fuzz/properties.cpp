#include "tests/fuzz/properties.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "core/base/files/input_file.hpp"
#include "tests/support/byte_sources.hpp"

namespace mapproof::fuzz {
namespace {

/// FNV-1a.
std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return hash;
}

/// What came of reading: a result, or an error's text without the name of the input.
struct Read {
  std::string text, error;
  std::exception_ptr thrown = {};
  bool operator==(const Read& other) const { return text == other.text && error == other.error; }
};

std::string without_name(std::string text, const std::string& name) {
  for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; at += kSource.size())
    text.replace(at, name.size(), kSource);
  return text;
}

Read read_of(ByteSource source, const ReadText& read) {
  try {
    return {without_name(read(source), source.name()), {}};
  } catch (const IoError& error) {
    return {{}, without_name(error.what(), source.name()), std::current_exception()};
  } catch (const InvalidInput& error) {
    return {{}, without_name(error.what(), source.name()), std::current_exception()};
  }
}

void expect_same(const std::string& way, const Read& one, const Read& other) {
  if (one == other) return;
  found("the same " + way,
        "from memory: " + one.text + one.error + "\n" + way + ": " + other.text + other.error);
}

/// The result of the same bytes through a pipe that this process inherited.
Read through_pipe(std::string_view bytes, const ReadText& read) {
  int ends[2];
  if (::pipe(ends) != 0) std::abort();
  const auto write_all = [&, end = ends[1]] {
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t count = ::write(end, bytes.data() + at, bytes.size() - at);
      if (count <= 0) break;
      at += static_cast<std::size_t>(count);
    }
    ::close(end);
  };
  // A thread for what a pipe does not hold.
  std::jthread writer;
  if (bytes.size() <= PIPE_BUF)
    write_all();
  else
    writer = std::jthread(write_all);
  Read result = read_of(ByteSource("/dev/fd/" + std::to_string(ends[0])), read);
  // A reader that stopped at an error leaves bytes behind.
  char rest[4096];
  while (::read(ends[0], rest, sizeof rest) > 0) {
  }
  ::close(ends[0]);
  return result;
}

}  // namespace

void found(const std::string& property, const std::string& why) {
  std::fprintf(stderr, "mapproof: does not hold: %s: %s\n", property.c_str(), why.c_str());
  std::abort();
}

void expect_equal(const std::string& property, std::string_view a, std::string_view b) {
  if (a == b) return;
  const auto at =
      static_cast<std::size_t>(std::distance(a.begin(), std::ranges::mismatch(a, b).in1));
  const std::size_t from = at < 200 ? 0 : at - 200;
  found(property, "from byte " + std::to_string(at) + " on:\n" +
                      std::string(a.substr(std::min(from, a.size()), 400)) + "\n---\n" +
                      std::string(b.substr(std::min(from, b.size()), 400)));
}

std::string read_in_any_way(std::string_view bytes, const ReadText& read) {
  const std::uint64_t hash = hash_of(bytes);
  const std::string text(bytes);
  const Read whole = read_of(test::source_of(text, ByteSource::kPeek, kSource), read);
  const std::size_t piece = 1 + hash % 61;
  expect_same("in pieces of " + std::to_string(piece), whole,
              read_of(test::source_of(text, piece, kSource), read));
  // Bytes that hold the name of a source themselves would be changed by without_name().
  if (hash / 64 % 16 == 0 && bytes.find("/fd/") == std::string_view::npos &&
      bytes.find(kSource) == std::string_view::npos) {
    const Descriptor file = anonymous_file(bytes, kSource);
    expect_same("from a file", whole, read_of(ByteSource(path_of(file)), read));
    expect_same("through a pipe", whole, through_pipe(bytes, read));
  }
  if (whole.thrown) std::rethrow_exception(whole.thrown);
  return whole.text;
}

}  // namespace mapproof::fuzz
