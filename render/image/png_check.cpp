#include "render/image/png_check.hpp"

#include <cstdint>

#include <fmt/format.h>
#include <libdeflate.h>

#include "render/image/png_chunks.hpp"

namespace mapproof {
namespace {

std::uint32_t checksum(std::string_view bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}

}  // namespace

std::string png_problem(std::string_view bytes) {
  if (!bytes.starts_with(kPngSignature)) return "is not a PNG: the signature is missing";
  constexpr std::size_t kFrame = 12;  // Length, type and checksum of a chunk.
  std::size_t at = kPngSignature.size();
  for (std::size_t chunk = 0;; ++chunk) {
    const std::string_view rest = bytes.substr(at);
    if (rest.size() < kFrame || big_endian(rest) > rest.size() - kFrame)
      return fmt::format("byte {}: is truncated", at);
    const std::size_t length = big_endian(rest);
    const std::string_view type = rest.substr(4, 4);
    if (checksum(rest.substr(4, length + 4)) != big_endian(rest.substr(length + 8)))
      return fmt::format("byte {}: a chunk's checksum is wrong", at);
    if (chunk == 0 && type != "IHDR") return fmt::format("byte {}: expected IHDR", at);
    at += length + kFrame;
    if (type == "IEND") break;
  }
  return at == bytes.size() ? "" : fmt::format("byte {}: nothing may follow IEND", at);
}

}  // namespace mapproof
