#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace mapproof {

/// SHA-256 of bytes that come in parts.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);
  /// The file as it is, a part at a time. @throws IoError.
  void add_file(const std::filesystem::path& file);

  /// Of what was added, as 64 hexadecimal digits; nothing can be added after it.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// SHA-256 [fips180-4].
std::array<std::uint8_t, 32> sha256(std::string_view bytes);

/// The same as 64 hexadecimal digits, small letters.
std::string sha256_hex(std::string_view bytes);

}  // namespace mapproof
