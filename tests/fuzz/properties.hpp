#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"

namespace mapproof::fuzz {

/// What inputs are called in errors.
inline const std::string kSource = "input";

/// Ends the process with a message on a property that failed.
[[noreturn]] void found(const std::string& property, const std::string& why);

/// Expects equal texts.
void expect_equal(const std::string& property, std::string_view a, std::string_view b);

/// What a reader made of a source, as text.
using ReadText = std::function<std::string(ByteSource&)>;

/// Reads the bytes from memory, and expects the same result, or the same error, of the bytes in
/// small pieces; of one input in sixteen also of a file and of a pipe. Which pieces and inputs
/// these are depends on the bytes alone.
/// @return The result. @throws what the reader throws.
std::string read_in_any_way(std::string_view bytes, const ReadText& read);

/// Parses the text, and expects that what is written of it is read as the same record: `write` of
/// both is equal. @throws what `parse` throws of the text.
template <typename Parse, typename Write>
void round_trip(std::string_view text, const Parse& parse, const Write& write) {
  const std::string written = write(parse(text, kSource));
  std::string again;
  try {
    again = write(parse(written, kSource));
  } catch (const std::exception& error) {
    found("what is written is read back", std::string(error.what()) + "\n" + written);
  }
  expect_equal("what is written is read back as it was", written, again);
}

}  // namespace mapproof::fuzz
