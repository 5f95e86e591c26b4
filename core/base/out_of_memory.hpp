#pragma once

#include <array>
#include <new>
#include <string>

namespace mapproof {

/// What the program says of std::bad_alloc, and mapproof-scenes and mapproof-animation say to it.
inline constexpr const char* kOutOfMemory = "out of memory";

/// Memory ran out while a file was made: "out of memory: <path>".
class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(const std::string& path) noexcept;
  const char* what() const noexcept override { return words_.data(); }

 private:
  std::array<char, 400> words_{};  // There is none left for a string.
};

}  // namespace mapproof
