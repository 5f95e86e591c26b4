#pragma once

#include <stdexcept>
#include <string>

namespace mapproof {

/// A value that breaks the stated bounds of what it is given to.
class InvalidInput : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Trouble with a file: "<path>: <line or JSON pointer>: <what>", or without the middle part.
class IoError : public std::runtime_error {
 public:
  IoError(const std::string& path, const std::string& what);
  IoError(const std::string& path, const std::string& location, const std::string& what);
};

/// `text` fit for one line of a terminal: what is hidden (see utf8.hpp) as \u{NNNN}, bytes that are
/// no UTF-8 as \xNN, at most `limit` characters, the rest as "...".
std::string printable(const std::string& text, std::size_t limit = 80);

}  // namespace mapproof
