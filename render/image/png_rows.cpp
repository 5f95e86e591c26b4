#include "render/image/png_rows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <new>

#include <libdeflate.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

using Bytes = std::vector<unsigned char>;

/// The bytes of a pixel, with room for sums: one register. Bytes are spread and gathered by shifts,
/// as baseline processors have no instruction for it.
using Lanes = std::int16_t __attribute__((vector_size(16)));
using Halves = std::uint64_t __attribute__((vector_size(16)));

template <int Step>
Lanes load(const unsigned char* bytes) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes, Step);
  std::uint64_t spread = word;
  spread = (spread | spread << 16) & 0x0000FFFF0000FFFFu;
  spread = (spread | spread << 8) & 0x00FF00FF00FF00FFu;
  return reinterpret_cast<Lanes>(Halves{spread, 0});
}

/// @pre Lanes are 0 to 255.
template <int Step>
void store(Lanes lanes, unsigned char* bytes) {
  std::uint64_t spread = reinterpret_cast<Halves>(lanes)[0];
  spread = (spread | spread >> 8) & 0x0000FFFF0000FFFFu;
  const auto word = static_cast<std::uint32_t>(spread | spread >> 16);
  std::memcpy(bytes, &word, Step);
}

static_assert(std::endian::native == std::endian::little);

Lanes absolute(Lanes lanes) { return lanes > -lanes ? lanes : -lanes; }

Lanes paeth(Lanes left, Lanes above, Lanes corner) {
  const Lanes to_left = absolute(above - corner), to_above = absolute(left - corner);
  const Lanes to_corner = absolute(left + above - corner - corner);
  const Lanes other = to_above <= to_corner ? above : corner;
  return (to_left <= to_above) & (to_left <= to_corner) ? left : other;
}

/// Takes the filter off a row [PNG specification, 9.2], pixel by pixel: `above` is the row before.
template <int Step>
void unfilter(int filter, const unsigned char* raw, const unsigned char* above, unsigned char* row,
              std::size_t count) {
  Lanes left{}, corner{};
  const auto each = [&](auto predicted) {
    for (std::size_t i = 0; i < count; i += Step) {
      const Lanes top = load<Step>(above + i);
      left = (load<Step>(raw + i) + predicted(top)) & 0xFF;
      store<Step>(left, row + i);
      corner = top;
    }
  };
  switch (filter) {
    case 0:
      std::memcpy(row, raw, count);
      break;
    case 1:
      each([&](Lanes) { return left; });
      break;
    case 2:
      for (std::size_t i = 0; i < count; ++i)
        row[i] = static_cast<unsigned char>(raw[i] + above[i]);
      break;
    case 3:
      each([&](Lanes top) { return (left + top) >> 1; });
      break;
    case 4:
      each([&](Lanes top) { return paeth(left, top, corner); });
      break;
    default:
      throw InvalidInput("a row has no filter that PNG knows");
  }
}

std::array<std::uint32_t, 256> colours_of(const PngHeader& header, std::string_view palette) {
  std::array<std::uint32_t, 256> colours{};
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(palette[i]); };
  for (std::uint32_t i = 0; i < 256; ++i)
    if (header.colour == 0)
      colours[i] = i * 0x010101u;
    else if (3 * i + 2 < palette.size())
      colours[i] =
          static_cast<std::uint32_t>(byte(3 * i) << 16 | byte(3 * i + 1) << 8 | byte(3 * i + 2));
  return colours;
}

/// Unfilters and widens all rows. The raw ones lie at the end of the memory whose beginning takes
/// the pixels, so that no pixel is written over a row that is still to be read.
///
/// @return False if some pixel is not opaque.
template <int Step>
bool widen(const PngHeader& header, const unsigned char* raw, std::string_view palette,
           std::uint32_t* pixels) {
  const std::size_t count = static_cast<std::size_t>(Step) * header.width;
  Bytes one(count + 1), other(count + 1);  // Pixels are taken four bytes at a time.
  unsigned char *above = one.data(), *row = other.data();
  const auto colours = colours_of(header, palette);
  std::uint32_t alpha = 0xFF000000u;
  for (std::uint32_t y = 0; y < header.height; ++y, raw += count + 1, pixels += header.width) {
    unfilter<Step>(raw[0], raw + 1, above, row, count);
    for (std::size_t x = 0; x < header.width; ++x)
      if constexpr (Step == 1) {
        pixels[x] = colours[row[x]];
      } else {
        std::uint32_t word = 0;
        std::memcpy(&word, row + Step * x, 4);
        pixels[x] = __builtin_bswap32(word) >> 8;
        if constexpr (Step == 4) alpha &= word;
      }
    std::swap(above, row);
  }
  return alpha >> 24 == 0xFF;
}

}  // namespace

bool has_quick_rows(const PngHeader& header) {
  return header.depth == 8 && header.interlace == 0 && header.colour != 4;
}

std::optional<Image> quick_rows(const PngHeader& header, std::string_view compressed,
                                std::string_view palette) {
  const std::size_t width = header.width, height = header.height;
  const std::size_t raw_bytes = (header.channels() * width + 1) * height;
  Image image{static_cast<int>(width), static_cast<int>(height), {}};
  // Rows of four channels are longer than their pixels, by the byte that names the filter.
  image.pixels.resize(std::max(width * height, (raw_bytes + 3) / 4));
  auto* end = reinterpret_cast<unsigned char*>(image.pixels.data() + image.pixels.size());
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!inflater) throw std::bad_alloc();
  std::size_t used = 0;
  const libdeflate_result result =
      libdeflate_zlib_decompress_ex(inflater.get(), compressed.data(), compressed.size(),
                                    end - raw_bytes, raw_bytes, &used, nullptr);
  if (result == LIBDEFLATE_INSUFFICIENT_SPACE)
    throw InvalidInput("its rows are more than its header says");
  if (result == LIBDEFLATE_SHORT_OUTPUT)
    throw InvalidInput("its rows are fewer than its header says");
  if (result != LIBDEFLATE_SUCCESS) throw InvalidInput("its compressed rows are damaged");
  if (used != compressed.size()) throw InvalidInput("bytes follow its compressed rows");
  const auto fill = header.channels() == 1   ? widen<1>
                    : header.channels() == 3 ? widen<3>
                                             : widen<4>;
  if (!fill(header, end - raw_bytes, palette, image.pixels.data())) return std::nullopt;
  image.pixels.resize(width * height);
  return image;
}

}  // namespace mapproof
