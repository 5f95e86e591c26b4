#include "render/image/deflate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include <libdeflate.h>

#include "render/image/prefix_code.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongest = 258;
constexpr std::size_t kWindow = 32768;
constexpr std::size_t kShortest = 4;  // A match of three costs about as much as its bytes.
constexpr std::size_t kGood = 16;     // Not worth a look elsewhere.
constexpr unsigned kEnd = 256;

/// A byte (distance 0) or a copy of `value` bytes from `distance` back.
struct Token {
  std::uint16_t value = 0;
  std::uint16_t distance = 0;
};

/// How many bytes at `a` equal those at `b`, at most `most`.
std::size_t equal_bytes(const char* a, const char* b, std::size_t most) {
  std::size_t count = 0;
  for (; count + 8 <= most; count += 8) {
    std::uint64_t x = 0, y = 0;
    std::memcpy(&x, a + count, 8);
    std::memcpy(&y, b + count, 8);
    if (x != y) return count + static_cast<std::size_t>(std::countr_zero(x ^ y)) / 8;
  }
  while (count < most && a[count] == b[count]) ++count;
  return count;
}

/// Finds what can be copied: from the row above, from the byte before, from anywhere.
class Matcher {
 public:
  Matcher(std::string_view bytes, std::size_t stride)
      : bytes_(bytes), stride_(stride), places_(std::size_t{1} << kHashBits, kNowhere) {}

  std::vector<Token> tokens() {
    std::vector<Token> found;
    found.reserve(bytes_.size() / 32 + 64);
    for (std::size_t at = 0; at < bytes_.size();) {
      const auto [length, distance] = best_at(at);
      if (length >= kShortest) {
        found.push_back({static_cast<std::uint16_t>(length), static_cast<std::uint16_t>(distance)});
        at += length;
      } else {
        found.push_back({static_cast<unsigned char>(bytes_[at]), 0});
        ++at;
      }
    }
    return found;
  }

 private:
  static constexpr int kHashBits = 14;
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFF;
  struct Match {
    std::size_t length = 0;
    std::size_t distance = 0;
  };

  Match best_at(std::size_t at) {
    Match best;
    try_match(at, 1, best);  // First: among equals it takes the fewest bits.
    if (best.length < kLongest && stride_ <= kWindow) try_match(at, stride_, best);
    if (best.length >= kGood || at + kShortest > bytes_.size()) return best;
    std::uint32_t head = 0;
    std::memcpy(&head, bytes_.data() + at, 4);
    std::uint32_t& place = places_[(head * 2654435761u) >> (32 - kHashBits)];
    if (place != kNowhere && at - place <= kWindow) try_match(at, at - place, best);
    place = static_cast<std::uint32_t>(at);
    return best;
  }

  void try_match(std::size_t at, std::size_t distance, Match& best) const {
    if (distance > at) return;
    const std::size_t most = std::min(kLongest, bytes_.size() - at);
    const std::size_t length = equal_bytes(bytes_.data() + at, bytes_.data() + at - distance, most);
    if (length > best.length) best = {length, distance};
  }

  std::string_view bytes_;
  std::size_t stride_;
  std::vector<std::uint32_t> places_;
};

class BitWriter {
 public:
  explicit BitWriter(std::string& out) : out_(out) {}

  void put(unsigned bits, int count) {
    held_ |= static_cast<std::uint64_t>(bits) << count_;
    for (count_ += count; count_ >= 8; count_ -= 8, held_ >>= 8) out_ += static_cast<char>(held_);
  }
  void flush() { put(0, (8 - count_) % 8); }

 private:
  std::string& out_;
  std::uint64_t held_ = 0;
  int count_ = 0;
};

/// The symbol of a length or distance and the bits that follow it [rfc1951, section 3.2.5].
struct Symbol {
  unsigned code = 0;
  int extra_bits = 0;
  unsigned extra = 0;
};

Symbol length_symbol(unsigned length) {
  if (length == kLongest) return {285, 0, 0};
  const unsigned offset = length - 3;
  if (offset < 8) return {257 + offset, 0, 0};
  const int bits = std::bit_width(offset) - 3;
  return {257 + 4 * static_cast<unsigned>(bits) + (offset >> bits), bits,
          offset & ((1u << bits) - 1)};
}

Symbol distance_symbol(unsigned distance) {
  const unsigned offset = distance - 1;
  if (offset < 4) return {offset, 0, 0};
  const int bits = std::bit_width(offset) - 2;
  return {2 * static_cast<unsigned>(bits) + (offset >> bits), bits, offset & ((1u << bits) - 1)};
}

/// Writes tokens as one block with codes of its own.
class BlockWriter {
 public:
  BlockWriter(const std::vector<Token>& tokens, std::string& out) : tokens_(tokens), bits_(out) {}

  void write() {
    count_symbols();
    bits_.put(1, 1);  // The last block,
    bits_.put(2, 2);  // with codes of its own.
    write_codes();
    for (const Token& token : tokens_) write_token(token);
    put(literals_, kEnd);
    bits_.flush();
  }

 private:
  void count_symbols() {
    std::array<std::uint32_t, 286> literals{};
    std::array<std::uint32_t, 30> distances{};
    for (const Token& token : tokens_) {
      ++literals[token.distance == 0 ? token.value : length_symbol(token.value).code];
      if (token.distance != 0) ++distances[distance_symbol(token.distance).code];
    }
    ++literals[kEnd];
    literals_ = prefix_code(literals, 15);
    distances_ = prefix_code(distances, 15);
  }

  /// The lengths of both codes, in a third code.
  void write_codes() {
    std::vector<std::uint8_t> lengths = literals_.lengths;
    lengths.insert(lengths.end(), distances_.lengths.begin(), distances_.lengths.end());
    std::array<std::uint32_t, 19> counts{};
    for (const std::uint8_t length : lengths) ++counts[length];
    const PrefixCode code = prefix_code(counts, 7);
    bits_.put(286 - 257, 5);
    bits_.put(30 - 1, 5);
    bits_.put(19 - 4, 4);
    for (const int symbol : {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15})
      bits_.put(code.lengths[symbol], 3);
    for (const std::uint8_t length : lengths) put(code, length);
  }

  void write_token(const Token& token) {
    if (token.distance == 0) return put(literals_, token.value);
    const Symbol length = length_symbol(token.value);
    put(literals_, length.code);
    bits_.put(length.extra, length.extra_bits);
    const Symbol distance = distance_symbol(token.distance);
    put(distances_, distance.code);
    bits_.put(distance.extra, distance.extra_bits);
  }

  void put(const PrefixCode& code, unsigned symbol) {
    bits_.put(code.codes[symbol], code.lengths[symbol]);
  }

  const std::vector<Token>& tokens_;
  BitWriter bits_;
  PrefixCode literals_;
  PrefixCode distances_;
};

}  // namespace

std::string deflate_drawing(std::string_view bytes, std::size_t stride) {
  std::string out("\x78\x01", 2);
  BlockWriter(Matcher(bytes, stride).tokens(), out).write();
  const std::uint32_t sum = libdeflate_adler32(1, bytes.data(), bytes.size());
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(sum >> shift);
  return out;
}

}  // namespace mapproof
