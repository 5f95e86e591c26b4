#include "render/image/png_colour.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <libdeflate.h>

#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

/// The data of the first chunk of a type; null if there is none.
const PngChunk* chunk_of(const std::vector<PngChunk>& chunks, std::string_view type) {
  const auto found = std::ranges::find(chunks, type, &PngChunk::type);
  return found == chunks.end() ? nullptr : &*found;
}

/// What zlib packed; empty if it is damaged or unpacks to more than 4 MiB.
std::string unpacked(std::string_view packed) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!inflater) throw std::bad_alloc();
  for (std::size_t room = std::size_t{1} << 16; room <= std::size_t{1} << 22; room *= 4) {
    std::string bytes(room, '\0');
    std::size_t count = 0;
    const libdeflate_result result = libdeflate_zlib_decompress(
        inflater.get(), packed.data(), packed.size(), bytes.data(), room, &count);
    if (result == LIBDEFLATE_SUCCESS) return bytes.substr(0, count);
    if (result != LIBDEFLATE_INSUFFICIENT_SPACE) return {};
  }
  return {};
}

/// An ICC profile without the date when it was made and the id that a program computes of it.
std::string without_date(std::string profile) {
  constexpr std::size_t kHead = 128;
  if (profile.size() < kHead) return profile;
  std::fill_n(profile.begin() + 24, 12, '\0');
  std::fill_n(profile.begin() + 84, 16, '\0');
  return profile;
}

/// iCCP: a name, its end, how it is packed, the profile.
PngColour of_profile(std::string_view data) {
  const std::size_t end = data.find('\0');
  if (end == std::string_view::npos || end + 2 > data.size())
    return {"a damaged profile", std::string(data)};
  std::string content = without_date(unpacked(data.substr(end + 2)));
  if (content.empty()) content = data;
  return {fmt::format("the profile \"{}\"", printable(std::string(data.substr(0, end)), 80)),
          "iCCP" + content};
}

/// cICP: primaries, transfer, matrix, range, each a number of ITU-T H.273.
PngColour of_code_points(std::string_view data) {
  using namespace std::string_view_literals;
  if (data == "\1\15\0\1"sv) return {};
  std::string label = "the code points";
  for (const char byte : data.substr(0, 4))
    label += fmt::format(" {}", static_cast<unsigned char>(byte));
  return {label, "cICP" + std::string(data)};
}

/// White, red, green and blue of sRGB, 100 000 times x and y.
constexpr std::array kPrimaries = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};

bool are_of_srgb(std::string_view primaries) {
  constexpr int kRounding = 100;
  if (primaries.size() != 4 * kPrimaries.size()) return false;
  for (std::size_t i = 0; i < kPrimaries.size(); ++i)
    if (std::abs(static_cast<std::int64_t>(big_endian(primaries.substr(4 * i))) - kPrimaries[i]) >
        kRounding)
      return false;
  return true;
}

PngColour of_gamma(const PngChunk* gamma, const PngChunk* primaries) {
  // 1/2.2, which programs write for sRGB.
  constexpr std::int64_t kGamma = 45455, kRounding = 100;
  PngColour colour;
  if (gamma && gamma->data.size() == 4 &&
      std::abs(static_cast<std::int64_t>(big_endian(gamma->data)) - kGamma) > kRounding)
    colour = {fmt::format("gamma {:.5g}", big_endian(gamma->data) / 1e5),
              "gAMA" + std::string(gamma->data)};
  if (primaries && !are_of_srgb(primaries->data)) {
    colour.label += " with other primaries";
    colour.content += "cHRM" + std::string(primaries->data);
  }
  return colour;
}

}  // namespace

PngColour png_colour(const std::vector<PngChunk>& chunks) {
  if (const PngChunk* chunk = chunk_of(chunks, "cICP")) return of_code_points(chunk->data);
  if (const PngChunk* chunk = chunk_of(chunks, "iCCP")) return of_profile(chunk->data);
  if (chunk_of(chunks, "sRGB")) return {};
  return of_gamma(chunk_of(chunks, "gAMA"), chunk_of(chunks, "cHRM"));
}

}  // namespace mapproof
