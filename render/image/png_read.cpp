#include "render/image/png_read.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <libdeflate.h>

#include "core/base/errors.hpp"
#include "render/image/image.hpp"
#include "render/image/png_check.hpp"
#include "render/image/png_chunks.hpp"
#include "render/image/png_rows.hpp"

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

/// How many bytes are zero from the first on, in steps of 8.
std::size_t zeros_at(const unsigned char* bytes, std::size_t count) {
  std::size_t zeros = 0;
  for (std::uint64_t word = 0; zeros + sizeof word <= count; zeros += sizeof word) {
    std::memcpy(&word, bytes + zeros, sizeof word);
    if (word != 0) break;
  }
  return zeros;
}

bool is_zero(const unsigned char* bytes, std::size_t count) {
  const std::size_t zeros = zeros_at(bytes, count);
  return count - zeros < 8 &&
         std::all_of(bytes + zeros, bytes + count, [](auto b) { return b == 0; });
}

/// Fills in the pixels whose bytes are zero from here on, if they all repeat the one to the left,
/// or the row above.
/// @return Their bytes.
/// @pre Not at the first pixel.
template <int Step>
std::size_t fill_zeros(int filter, const unsigned char* raw, const unsigned char* above,
                       unsigned char* row, std::size_t count) {
  // Paeth: what equals the one above while the one to its left does. Of filter 3 none.
  const bool repeats_above = filter == 4 && std::memcmp(row - Step, above - Step, Step) == 0;
  if (filter != 1 && !repeats_above) return 0;
  const std::size_t zeros = zeros_at(raw, count) / Step * Step;
  if (repeats_above) {
    std::memcpy(row, above, zeros);
    return zeros;
  }
  for (std::size_t done = 0; done < zeros;) {
    const std::size_t part = std::min(std::max<std::size_t>(done, Step), zeros - done);
    std::memcpy(row + done, done == 0 ? row - Step : row, part);
    done += part;
  }
  return zeros;
}

/// Takes the filter off a row [PNG specification, 9.2], pixel by pixel: `above` is the row before.
template <int Step>
void unfilter(int filter, const unsigned char* raw, const unsigned char* above, unsigned char* row,
              std::size_t count) {
  Lanes left{}, corner{};
  const auto each = [&](auto predicted) {
    for (std::size_t i = 0; i < count; i += Step) {
      if (i > 0)
        if (const std::size_t zeros =
                fill_zeros<Step>(filter, raw + i, above + i, row + i, count - i)) {
          i += zeros - Step;
          left = load<Step>(row + i);
          corner = load<Step>(above + i);
          continue;
        }
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
  constexpr int kUp = 2;
  for (std::uint32_t y = 0; y < header.height; ++y, raw += count + 1, pixels += header.width) {
    if (y > 0 && raw[0] == kUp && is_zero(raw + 1, count)) {
      std::memcpy(pixels, pixels - header.width, sizeof *pixels * header.width);
      continue;
    }
    unfilter<Step>(raw[0], raw + 1, above, row, count);
    for (std::size_t x = 0; x < header.width; ++x)
      if constexpr (Step == 1) {
        pixels[x] = colours[row[x]];
      } else {
        std::uint32_t word = 0;
        std::memcpy(&word, row + Step * x, 4);
        // The bytes in the opposite order, by what every processor does for several at once.
        pixels[x] = (word & 0xFF) << 16 | (word & 0xFF00) | (word >> 16 & 0xFF);
        if constexpr (Step == 4) alpha &= word;
      }
    std::swap(above, row);
  }
  return alpha >> 24 == 0xFF;
}

/// Whether quick_rows can read such an image: 8 bits a sample, not interlaced,
/// not grey with alpha. The caller searches for tRNS.
bool has_quick_rows(const PngHeader& header) {
  return header.depth == 8 && header.interlace == 0 && header.colour != 4;
}

/// The pixels of the compressed rows, in a third of libpng's time and without a second buffer.
/// @param palette  PLTE's bytes; colours beyond it are black.
/// @return Empty if some pixel is not opaque.
/// @throws InvalidInput if the rows are damaged or not as long as the header requires.
/// @pre has_quick_rows(header); width and height are within bounds.
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

void read_words(const PngChunk& chunk, PngFile& file) {
  const std::size_t key_end = chunk.data.find('\0');
  if (key_end == std::string_view::npos || chunk.data.size() > 65536) return;
  std::string_view text = chunk.data.substr(key_end + 1);
  if (chunk.type == "iTXt") {
    // Compressed or not, how, language, its end, translated keyword, its end.
    if (text.size() < 2 || text[0] != 0) return;
    text.remove_prefix(2);
    for (int field = 0; field < 2; ++field) {
      const std::size_t end = text.find('\0');
      if (end == std::string_view::npos) return;
      text.remove_prefix(end + 1);
    }
  }
  file.texts[std::string(chunk.data.substr(0, key_end))] = text;
}

/// Pixels of an image that is held whole.
std::uint64_t most_pixels(const PngHeader& header) {
  return kMostPngBytes / (header.interlace == 0 ? 4 : header.depth == 16 ? 12 : 8);
}

std::uint64_t pixels_of(const PngHeader& header) {
  return std::uint64_t{header.width} * header.height;
}

[[noreturn]] void refuse_size(const PngHeader& header, std::uint64_t most) {
  throw InvalidInput(fmt::format("{} x {} pixels are more than the {} that are read", header.width,
                                 header.height, most));
}

/// What holds however the rows are read.
void check_size(const PngHeader& header, std::size_t compressed) {
  if (header.width > kMostPngWidth)
    throw InvalidInput(fmt::format("a width of {} pixels is more than the {} that are read",
                                   header.width, kMostPngWidth));
  if (pixels_of(header) > kMostPngPixels) refuse_size(header, kMostPngPixels);
  // Deflate makes at most 1032 bytes of one.
  const std::uint64_t bits = std::uint64_t{header.width} * header.channels() * header.depth;
  if (header.height * (bits / 8) > 1032 * static_cast<std::uint64_t>(compressed))
    throw InvalidInput(fmt::format("{} x {} pixels cannot be in {} bytes", header.width,
                                   header.height, compressed));
}

/// A file's chunks, sorted out and within bounds.
struct Parts {
  std::vector<PngChunk> chunks;
  PngHeader header;
  std::string gathered = {};  ///< The rows, if they are in several chunks.
  std::string_view rows = {}, palette = {};
  bool has_transparency = false;
};

/// Reads all but the pixels.
Parts read_parts(std::string_view bytes, PngFile& file) {
  if (const std::string problem = png_problem(bytes); !problem.empty()) throw InvalidInput(problem);
  Parts parts{.chunks = png_chunks(bytes), .header = {}};
  parts.header = file.header = png_header(parts.chunks.front());
  file.colour = png_colour(parts.chunks);
  std::size_t row_chunks = 0;
  for (const PngChunk& chunk : parts.chunks) {
    if (chunk.type == "PLTE") parts.palette = chunk.data;
    if (chunk.type == "tRNS") parts.has_transparency = true;
    if (chunk.type == "tIME") file.has_time = true;
    if (chunk.type == "tEXt" || chunk.type == "iTXt") read_words(chunk, file);
    if (chunk.type == "pHYs" && chunk.data.size() == 9)
      file.pixels_per_metre = big_endian(chunk.data);
    if (chunk.type != "IDAT") continue;
    if (row_chunks++ == 0) {
      parts.rows = chunk.data;
      continue;
    }
    if (parts.gathered.empty()) parts.gathered = parts.rows;
    parts.gathered += chunk.data;
  }
  if (!parts.gathered.empty()) parts.rows = parts.gathered;
  check_size(parts.header, parts.rows.size());
  if (parts.header.colour == 3 && parts.palette.empty())
    throw InvalidInput("its palette is missing");
  return parts;
}

}  // namespace

bool is_held_whole(const PngHeader& header) { return pixels_of(header) <= most_pixels(header); }

PngFile read_png_remarks(std::string_view bytes) {
  PngFile file;
  read_parts(bytes, file);
  return file;
}

PngFile read_png(std::string_view bytes) {
  PngFile file;
  Parts parts = read_parts(bytes, file);
  if (!is_held_whole(parts.header)) refuse_size(parts.header, most_pixels(parts.header));
  if (!parts.has_transparency && has_quick_rows(parts.header))
    if (std::optional<Image> image = quick_rows(parts.header, parts.rows, parts.palette)) {
      file.image = std::move(*image);
      return file;
    }
  file.image = {static_cast<int>(parts.header.width), static_cast<int>(parts.header.height), {}};
  file.image.pixels.resize(static_cast<std::size_t>(file.image.width) * file.image.height);
  PngRows rows(std::move(parts.chunks));
  rows.read(file.image.height, file.image.pixels.data(), nullptr);
  rows.finish();
  file.finer_digest = rows.finer_digest();
  return file;
}

}  // namespace mapproof
