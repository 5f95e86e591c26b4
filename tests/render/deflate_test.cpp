#include "render/image/deflate.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>
#include <libdeflate.h>

#include "core/base/random.hpp"
#include "render/image/prefix_code.hpp"

namespace mapproof {
namespace {

std::string inflated(const std::string& stream, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> reader(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  std::string bytes(size, '?');
  const auto result = libdeflate_zlib_decompress(reader.get(), stream.data(), stream.size(),
                                                 bytes.data(), bytes.size(), nullptr);
  return result == LIBDEFLATE_SUCCESS ? bytes : "not a zlib stream";
}

TEST(DeflateDrawing, IsUndoneByAnotherImplementation) {
  Random random(5);
  for (const std::size_t size : {0, 1, 2, 3, 4, 7, 258, 259, 1000, 40000, 200000})
    for (const unsigned values : {1u, 2u, 7u, 256u})
      for (const std::size_t stride : {1, 3, 100, 1201, 40000})
        for (const double change : {0.0, 0.01, 0.5, 1.0}) {
          std::string bytes(size, '\0');
          char value = 0;
          for (char& byte : bytes) {
            if (random.uniform() < change) value = static_cast<char>(random.next() % values);
            byte = value;
          }
          EXPECT_TRUE(inflated(deflate_drawing(bytes, stride), size) == bytes)
              << size << ' ' << values << ' ' << stride << ' ' << change;
        }
}

TEST(DeflateDrawing, ReachesEveryLengthAndFarDistances) {
  Random random(6);
  std::string bytes;
  for (int i = 0; i < 40000; ++i) bytes += static_cast<char>(random.next());
  for (std::size_t length = 3; length < 300; ++length) {
    const std::size_t from = bytes.size() - 4000 - 90 * length;
    bytes += bytes.substr(from, length);
    bytes += static_cast<char>(random.next());
  }
  for (const std::size_t stride : {4000, 32768, 32769})
    EXPECT_TRUE(inflated(deflate_drawing(bytes, stride), bytes.size()) == bytes) << stride;
}

TEST(DeflateDrawing, ShrinksABlankPageFivehundredfold) {
  const std::string bytes(1201 * 900, '\0');
  EXPECT_LT(deflate_drawing(bytes, 1201).size(), 2000u);
}

TEST(PrefixCode, IsCompleteAndWithinItsLimit) {
  std::vector<std::uint32_t> counts;  // Of Fibonacci: the deepest tree there is.
  std::uint32_t a = 1, b = 1;
  for (int i = 0; i < 40; ++i) counts.push_back(a), a = std::exchange(b, a + b);
  for (const int limit : {6, 7, 15}) {
    const PrefixCode code = prefix_code(counts, limit);
    double sum = 0.0;
    for (const std::uint8_t length : code.lengths) {
      EXPECT_GE(length, 1);
      EXPECT_LE(length, limit);
      sum += std::pow(0.5, length);
    }
    EXPECT_EQ(sum, 1.0) << limit;
  }
}

TEST(PrefixCode, GivesFrequentSymbolsShortCodes) {
  const std::vector<std::uint32_t> counts = {1, 100, 0, 10};
  EXPECT_EQ(prefix_code(counts, 15).lengths, (std::vector<std::uint8_t>{2, 1, 0, 2}));
}

}  // namespace
}  // namespace mapproof
