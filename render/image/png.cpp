#include "render/image/png.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <libdeflate.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr std::uint32_t kColourBits = 0xFFFFFF;
constexpr std::size_t kMostColours = 8192;  // Beyond that it is a photograph, not a drawing.

/// The colours of an image with their counts, in the order in which they are met; open addressing.
class Histogram {
 public:
  struct Entry {
    std::uint32_t colour = 0;
    std::uint32_t count = 0;
    std::uint8_t code = 0;  ///< Its number in the palette.
  };

  Histogram() : slots_(4 * kMostColours) {}

  /// The entry's number; empty once there are too many.
  std::optional<std::size_t> find_or_add(std::uint32_t colour) {
    std::size_t slot = (colour * 2654435761u) >> 17;
    while (slots_[slot] != 0) {
      if (entries[slots_[slot] - 1u].colour == colour) return slots_[slot] - 1u;
      slot = (slot + 1) % slots_.size();
    }
    if (entries.size() == kMostColours) return std::nullopt;
    entries.push_back({colour, 0, 0});
    slots_[slot] = static_cast<std::uint16_t>(entries.size());
    return entries.size() - 1;
  }

  std::vector<Entry> entries;

 private:
  std::vector<std::uint16_t> slots_;
};

/// A stretch of pixels of one colour; the last one of a row ends with it.
struct Run {
  std::uint16_t entry = 0;  ///< In the histogram.
  std::int32_t length = 0;
};

constexpr std::int32_t kSameAsAbove = -1;  ///< As a length: the row repeats the one above.

int run_end(const std::uint32_t* row, int begin, int width) {
  const std::uint32_t colour = row[begin];
  int end = begin + 1;
  constexpr int kBlock = 16;  // Compared at once; the compiler makes that a few instructions.
  for (; end + kBlock <= width; end += kBlock) {
    std::uint32_t differs = 0;
    for (int i = 0; i < kBlock; ++i) differs |= row[end + i] ^ colour;
    if (differs != 0) break;
  }
  while (end < width && row[end] == colour) ++end;
  return end;
}

/// The image's runs, its colours counted; empty if there are too many. Rows equal to the one above
/// are not counted: what counts is how much there is to see.
std::vector<Run> find_runs(const Image& image, Histogram& histogram) {
  std::vector<Run> runs;
  runs.reserve(65536);
  for (int y = 0; y < image.height; ++y) {
    const std::uint32_t* row = image.row(y);
    if (y > 0 && std::memcmp(row, image.row(y - 1), sizeof(*row) * image.width) == 0) {
      runs.push_back({0, kSameAsAbove});
      continue;
    }
    for (int begin = 0; begin < image.width;) {
      const int end = run_end(row, begin, image.width);
      const auto entry = histogram.find_or_add(row[begin] & kColourBits);
      if (!entry) return {};
      histogram.entries[*entry].count += static_cast<std::uint32_t>(end - begin);
      runs.push_back({static_cast<std::uint16_t>(*entry), end - begin});
      begin = end;
    }
  }
  return runs;
}

/// Colours of a palette, channel by channel, so that all are compared with one colour at once.
class ColourTable {
 public:
  ColourTable() {
    red_.fill(kNowhere);
    green_.fill(kNowhere);
    blue_.fill(kNowhere);
  }

  /// The first colour no farther than `most` in any channel and nearest; empty if there is none.
  std::optional<std::uint8_t> nearest(std::uint32_t colour, int most) const {
    const auto r = static_cast<std::int16_t>(colour >> 16);
    const auto g = static_cast<std::int16_t>((colour >> 8) & 0xFF);
    const auto b = static_cast<std::int16_t>(colour & 0xFF);
    std::array<std::int16_t, 256> away;
    std::int16_t least = kNowhere;
    const std::size_t end = (size_ + 15) / 16 * 16;
    for (std::size_t i = 0; i < end; ++i) {
      const std::int16_t d =
          std::max({distance(r, red_[i]), distance(g, green_[i]), distance(b, blue_[i])});
      away[i] = d;
      least = std::min(least, d);
    }
    if (least > most) return std::nullopt;
    return static_cast<std::uint8_t>(std::find(away.begin(), away.begin() + end, least) -
                                     away.begin());
  }

  /// False if it is full.
  bool add(std::uint32_t colour) {
    if (size_ == red_.size()) return false;
    red_[size_] = static_cast<std::int16_t>(colour >> 16);
    green_[size_] = static_cast<std::int16_t>((colour >> 8) & 0xFF);
    blue_[size_] = static_cast<std::int16_t>(colour & 0xFF);
    ++size_;
    return true;
  }

 private:
  static constexpr std::int16_t kNowhere = 4096;

  static std::int16_t distance(std::int16_t a, std::int16_t b) {
    return static_cast<std::int16_t>(std::max(a - b, b - a));
  }

  std::array<std::int16_t, 256> red_, green_, blue_;
  std::size_t size_ = 0;
};

/// A palette in which every colour finds one no farther than `most` in any channel; each that does
/// not founds one, the frequent ones first. False if 256 are too few.
bool group_colours(Histogram& histogram, const std::vector<std::size_t>& by_count, int most,
                   std::vector<std::uint32_t>& palette) {
  ColourTable table;
  palette.clear();
  for (const std::size_t index : by_count) {
    Histogram::Entry& entry = histogram.entries[index];
    if (const auto near = table.nearest(entry.colour, most)) {
      entry.code = *near;
      continue;
    }
    if (!table.add(entry.colour)) return false;
    entry.code = static_cast<std::uint8_t>(palette.size());
    palette.push_back(entry.colour);
  }
  return true;
}

bool choose_palette(Histogram& histogram, std::vector<std::uint32_t>& palette) {
  std::vector<std::size_t> by_count(histogram.entries.size());
  for (std::size_t i = 0; i < by_count.size(); ++i) by_count[i] = i;
  if (by_count.size() <= 256) return group_colours(histogram, by_count, 0, palette);
  std::ranges::stable_sort(by_count, std::ranges::greater{},
                           [&](std::size_t i) { return histogram.entries[i].count; });
  for (const int most : {4, 8, kMostColourShift})
    if (group_colours(histogram, by_count, most, palette)) return true;
  return false;
}

// A chunk's length ends here.
constexpr std::uint64_t kMostBytes = 0x7FFFFFFF;

void append_big_endian(std::string& out, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(value >> shift);
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_big_endian(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = out.size();
  out += type;
  out += data;
  append_big_endian(out, libdeflate_crc32(0, out.data() + start, out.size() - start));
}

std::string rgb_rows(const Image& image) {
  std::string bytes;
  bytes.resize((3 * static_cast<std::size_t>(image.width) + 1) * image.height);
  char* out = bytes.data();
  for (int y = 0; y < image.height; ++y) {
    *out++ = 0;
    const std::uint32_t* row = image.row(y);
    for (int x = 0; x < image.width; ++x) {
      *out++ = static_cast<char>(row[x] >> 16);
      *out++ = static_cast<char>(row[x] >> 8);
      *out++ = static_cast<char>(row[x]);
    }
  }
  return bytes;
}

std::string compressed(std::string_view bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(),
                                      out.size()));
  if (out.empty()) throw std::runtime_error("PNG: compression failed");
  return out;
}

/// What the header and the palette say.
struct Format {
  int width = 0;
  int height = 0;
  std::span<const std::uint32_t> colours = {};  ///< Empty: RGB.
};

std::string header(const Format& format) {
  std::string data;
  append_big_endian(data, static_cast<std::uint32_t>(format.width));
  append_big_endian(data, static_cast<std::uint32_t>(format.height));
  data += '\x08';  // Bits a sample.
  data += format.colours.empty() ? '\x02' : '\x03';
  data.append(3, '\0');  // Deflate, adaptive filters, not interlaced.
  return data;
}

void append_text(std::string& out, const std::string& key, const std::string& text) {
  bool plain = true;
  for (const char c : text) plain = plain && (c == '\n' || (c >= 0x20 && c < 0x7F));
  std::string data = key + '\0';
  if (!plain) data.append(4, '\0');  // Not compressed, no language, no translated keyword.
  append_chunk(out, plain ? "tEXt" : "iTXt", data + text);
}

}  // namespace

std::optional<PaletteImage> to_palette(const Image& image) {
  Histogram histogram;
  PaletteImage result;
  const std::vector<Run> runs = find_runs(image, histogram);
  if (runs.empty() || !choose_palette(histogram, result.colours)) return std::nullopt;
  const std::size_t stride = static_cast<std::size_t>(image.width) + 1;
  result.rows.resize(stride * image.height);
  char* row = result.rows.data();
  std::size_t filled = 1;
  for (const Run& run : runs) {
    if (run.length == kSameAsAbove) {
      std::memcpy(row, row - stride, stride);
      filled = stride;
    } else {
      std::memset(row + filled, histogram.entries[run.entry].code, run.length);
      filled += static_cast<std::size_t>(run.length);
    }
    if (filled < stride) continue;
    row += stride;
    filled = 1;
  }
  return result;
}

std::string png_texts(const std::vector<std::pair<std::string, std::string>>& texts) {
  std::string out;
  for (const auto& [key, text] : texts) append_text(out, key, text);
  return out;
}

namespace {

std::string png_file(const Format& format, std::string_view rows, const PngOptions& options) {
  std::string out = "\x89PNG\r\n\x1A\n";
  append_chunk(out, "IHDR", header(format));
  std::string density;
  const auto per_metre = static_cast<std::uint32_t>(std::lround(options.dpi / 0.0254));
  append_big_endian(density, per_metre);
  append_big_endian(density, per_metre);
  append_chunk(out, "pHYs", density + '\x01');
  out += png_texts(options.texts);
  if (!format.colours.empty()) {
    std::string colours;
    for (const std::uint32_t colour : format.colours)
      for (const int shift : {16, 8, 0}) colours += static_cast<char>(colour >> shift);
    append_chunk(out, "PLTE", colours);
  }
  append_chunk(out, "IDAT", compressed(rows, options.level));
  append_chunk(out, "IEND", "");
  return out;
}

}  // namespace

std::string encode_png(const Image& image, const PngOptions& options) {
  const bool sized =
      image.width >= 1 && image.height >= 1 && image.width <= 100000 && image.height <= 100000;
  if (sized && (3 * static_cast<std::uint64_t>(image.width) + 1) * image.height > kMostBytes)
    throw InvalidInput("encode_png: the image's rows exceed 2^31 - 1 bytes");
  if (!sized || image.pixels.size() < static_cast<std::size_t>(image.width) * image.height)
    throw InvalidInput("encode_png: an image without pixels, too large, or with too few of them");

  if (const std::optional<PaletteImage> indexed = to_palette(image))
    return encode_png(*indexed, image.width, options);
  return png_file({.width = image.width, .height = image.height}, rgb_rows(image), options);
}

std::string encode_png(const PaletteImage& image, int width, const PngOptions& options) {
  const std::size_t stride = static_cast<std::size_t>(std::max(width, 0)) + 1;
  const std::size_t height = image.rows.size() / stride;
  if (width < 1 || width > 100000 || height < 1 || height > 100000 ||
      image.rows.size() != stride * height || image.colours.empty() || image.colours.size() > 256)
    throw InvalidInput("encode_png: rows that are no image of this width, or no palette");
  return png_file({width, static_cast<int>(height), image.colours}, image.rows, options);
}

}  // namespace mapproof
