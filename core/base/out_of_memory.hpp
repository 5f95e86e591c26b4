#pragma once

#include <array>
#include <new>
#include <string>

namespace mapproof {

/// The message of std::bad_alloc, also of mapproof-scenes and mapproof-animation to mapproof.
inline constexpr const char* kOutOfMemory = "out of memory";

/// Memory ran out while a file was read or drawn: "out of memory: <path><remark>".
class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(const std::string& path, const char* remark = "") noexcept;
  const char* what() const noexcept override { return words_.data(); }

 private:
  std::array<char, 400> words_{};  // No memory is left for a string.
};

/// Bytes of memory that the process can still take: the least of what the machine has available, of
/// the process's limit of address space (ulimit -v), and of its control group's limit. Infinite if
/// none of them is known.
double available_memory_bytes();

}  // namespace mapproof
