#include "render/image/prefix_code.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace mapproof {
namespace {

/// Depth of each leaf of a Huffman tree [huffman1952]; ties by number, so that it is the same each
/// time.
std::vector<std::uint8_t> tree_depths(std::span<const std::uint32_t> counts) {
  using Node = std::pair<std::uint64_t, std::size_t>;  // Count, number: leaves before inner nodes.
  std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] != 0) open.emplace(counts[i], i);
  std::vector<std::uint8_t> depths(counts.size(), 0);
  if (open.size() == 1) depths[open.top().second] = 1;
  std::vector<std::size_t> parent(2 * counts.size(), 0);
  std::size_t next = counts.size();
  while (open.size() > 1) {
    const auto [count_a, a] = open.top();
    open.pop();
    const auto [count_b, b] = open.top();
    open.pop();
    parent[a] = parent[b] = next;
    open.emplace(count_a + count_b, next++);
  }
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] != 0)
      for (std::size_t node = parent[i]; node != 0; node = parent[node]) ++depths[i];
  return depths;
}

/// Cuts long codes to the limit, lengthens others until all fit again, and hands out what that left
/// over, since readers refuse a code with gaps.
void limit_lengths(std::vector<std::uint8_t>& lengths, int limit) {
  const auto share = [limit](int length) { return std::int64_t{1} << (limit - length); };
  if (*std::ranges::max_element(lengths) <= limit) return;
  std::int64_t room = share(0);
  for (std::uint8_t& length : lengths) {
    length = static_cast<std::uint8_t>(std::min<int>(length, limit));
    if (length != 0) room -= share(length);
  }
  while (room < 0) {
    auto longest = lengths.end();  // Of those that can grow: it costs the least.
    for (auto it = lengths.begin(); it != lengths.end(); ++it)
      if (*it != 0 && *it < limit && (longest == lengths.end() || *it > *longest)) longest = it;
    ++*longest;
    room += share(*longest);
  }
  while (room > 0)
    for (std::uint8_t& length : lengths)
      if (length > 1 && share(length) <= room) {
        room -= share(length);
        --length;
      }
}

std::uint16_t reversed(unsigned code, int length) {
  unsigned turned = 0;
  for (int i = 0; i < length; ++i) turned |= ((code >> i) & 1u) << (length - 1 - i);
  return static_cast<std::uint16_t>(turned);
}

}  // namespace

PrefixCode prefix_code(std::span<const std::uint32_t> counts, int limit) {
  PrefixCode code{tree_depths(counts), std::vector<std::uint16_t>(counts.size(), 0)};
  limit_lengths(code.lengths, limit);
  unsigned next = 0;
  for (int length = 1; length <= limit; ++length, next <<= 1)
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (code.lengths[i] == length) code.codes[i] = reversed(next++, length);
  return code;
}

}  // namespace mapproof
