#include "render/image/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

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
  int end = begin + 1;
  constexpr int kBlock = 16;  // Equal to those one to the left: compared at once.
  while (end + kBlock <= width && std::memcmp(row + end - 1, row + end, kBlock * sizeof(*row)) == 0)
    end += kBlock;
  while (end < width && row[end] == row[begin]) ++end;
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

bool choose_palette(Histogram& histogram, int most_shift, std::vector<std::uint32_t>& palette) {
  std::vector<std::size_t> by_count(histogram.entries.size());
  for (std::size_t i = 0; i < by_count.size(); ++i) by_count[i] = i;
  if (by_count.size() <= 256) return group_colours(histogram, by_count, 0, palette);
  std::ranges::stable_sort(by_count, std::ranges::greater{},
                           [&](std::size_t i) { return histogram.entries[i].count; });
  for (const int most : {kMostShadeShift, 8, kMostColourShift})
    if (most <= most_shift && group_colours(histogram, by_count, most, palette)) return true;
  return false;
}

constexpr std::size_t kMostPairs = 256;
constexpr std::size_t kChannels = 6;

struct ColourPair {
  std::uint64_t colours = 0;  ///< The first image's colour above the second's, 24 bits each.
  std::uint32_t index = 0;    ///< In the order in which pairs are met.
  std::uint32_t count = 0;
};

int channel(std::uint64_t colours, std::size_t index) {
  return static_cast<int>(colours >> (8 * index) & 0xFF);
}

/// The pairs of two images in the order in which they are met; open addressing.
class PairTable {
 public:
  PairTable() : slots_(std::size_t{1} << 12, 0) {}

  /// The index of the pair.
  std::uint32_t find_or_add(std::uint64_t colours) {
    std::size_t slot = slot_of(colours);
    while (slots_[slot] != 0) {
      if (pairs[slots_[slot] - 1].colours == colours) return slots_[slot] - 1;
      slot = (slot + 1) & (slots_.size() - 1);
    }
    const auto index = static_cast<std::uint32_t>(pairs.size());
    pairs.push_back({colours, index});
    slots_[slot] = index + 1;
    if (2 * pairs.size() > slots_.size()) grow();
    return index;
  }

  std::vector<ColourPair> pairs;

 private:
  std::size_t slot_of(std::uint64_t colours) const {
    return static_cast<std::size_t>(colours * 0x9E3779B97F4A7C15ULL >> 32) & (slots_.size() - 1);
  }

  void grow() {
    slots_.assign(2 * slots_.size(), 0);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      std::size_t slot = slot_of(pairs[i].colours);
      while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = static_cast<std::uint32_t>(i + 1);
    }
  }

  std::vector<std::uint32_t> slots_;  ///< One more than the index of a pair; 0: empty.
};

/// A part of the pairs, and the channel in which it is widest.
struct ColourBox {
  std::size_t begin = 0, end = 0;
  std::size_t widest = 0;
  int width = 0;  ///< In that channel.
  int middle = 0;
  std::uint64_t pixels = 0;

  /// Boxes of many pixels are cut first: those of a wide shade, in which steps would be seen.
  double weight() const { return width * std::sqrt(static_cast<double>(pixels)); }
};

ColourBox box_of(const std::vector<ColourPair>& pairs, std::size_t begin, std::size_t end) {
  std::array<int, kChannels> low, high;
  low.fill(255);
  high.fill(0);
  ColourBox box{.begin = begin, .end = end};
  for (std::size_t i = begin; i < end; ++i) {
    box.pixels += pairs[i].count;
    for (std::size_t c = 0; c < kChannels; ++c) {
      low[c] = std::min(low[c], channel(pairs[i].colours, c));
      high[c] = std::max(high[c], channel(pairs[i].colours, c));
    }
  }
  for (std::size_t c = 0; c < kChannels; ++c)
    if (high[c] - low[c] > box.width) {
      box.widest = c;
      box.width = high[c] - low[c];
      box.middle = (low[c] + high[c]) / 2;
    }
  return box;
}

std::vector<ColourBox> cut_boxes(std::vector<ColourPair>& pairs) {
  std::vector<ColourBox> boxes = {box_of(pairs, 0, pairs.size())};
  while (boxes.size() < kMostPairs) {
    const auto widest = std::ranges::max_element(boxes, {}, &ColourBox::weight);
    if (widest->width == 0) break;
    const ColourBox box = *widest;
    const auto first = pairs.begin() + static_cast<std::ptrdiff_t>(box.begin);
    const auto cut = std::stable_partition(
        first, pairs.begin() + static_cast<std::ptrdiff_t>(box.end),
        [&](const ColourPair& pair) { return channel(pair.colours, box.widest) <= box.middle; });
    const auto middle = static_cast<std::size_t>(cut - pairs.begin());
    *widest = box_of(pairs, box.begin, middle);
    boxes.push_back(box_of(pairs, middle, box.end));
  }
  return boxes;
}

}  // namespace

std::optional<PaletteImage> to_palette(const Image& image, int most_shift) {
  Histogram histogram;
  PaletteImage result;
  const std::vector<Run> runs = find_runs(image, histogram);
  if (runs.empty() || !choose_palette(histogram, most_shift, result.colours)) return std::nullopt;
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

TwoPalettes to_two_palettes(const Image& first, const Image& second) {
  if (first.width < 1 || first.height < 1 || first.width != second.width ||
      first.height != second.height)
    throw InvalidInput("to_two_palettes: images of two sizes, or without pixels");
  // Neighbours are often equal: a pair is looked for where it changes.
  PairTable table;
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(first.width) * first.height);
  std::uint64_t last = ~std::uint64_t{0};
  std::uint32_t index = 0;
  for (int y = 0; y < first.height; ++y) {
    const std::uint32_t *a = first.row(y), *b = second.row(y);
    for (int x = 0; x < first.width; ++x) {
      const std::uint64_t colours =
          static_cast<std::uint64_t>(a[x] & 0xFFFFFFU) << 24 | (b[x] & 0xFFFFFFU);
      if (colours != last) index = table.find_or_add(last = colours);
      ++table.pairs[index].count;
      indices.push_back(index);
    }
  }

  TwoPalettes result;
  std::vector<char> codes(table.pairs.size());
  std::vector<ColourPair> pairs = std::move(table.pairs);
  for (const ColourBox& box : cut_boxes(pairs)) {
    const auto begin = pairs.begin() + static_cast<std::ptrdiff_t>(box.begin);
    const auto end = pairs.begin() + static_cast<std::ptrdiff_t>(box.end);
    const std::uint64_t colours =
        std::ranges::max_element(begin, end, {}, &ColourPair::count)->colours;
    for (auto pair = begin; pair != end; ++pair)
      codes[pair->index] = static_cast<char>(result.first.size());
    result.first.push_back(static_cast<std::uint32_t>(colours >> 24));
    result.second.push_back(static_cast<std::uint32_t>(colours & 0xFFFFFF));
  }
  result.rows.reserve(indices.size() + static_cast<std::size_t>(first.height));
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (i % static_cast<std::size_t>(first.width) == 0) result.rows += '\0';
    result.rows += codes[indices[i]];
  }
  return result;
}

}  // namespace mapproof
