#include "core/base/files/unpacker.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/support/packing.hpp"

namespace mapproof {
namespace {

/// A way of packing, as its own library packs.
struct Packing {
  std::string name;
  std::string (*pack)(std::string_view bytes);
};

std::ostream& operator<<(std::ostream& out, const Packing& packing) { return out << packing.name; }

class EveryPacking : public ::testing::TestWithParam<Packing> {
 protected:
  static std::string packed(std::string_view bytes) { return GetParam().pack(bytes); }
};

/// All that comes out where `bytes` come in pieces.
std::string unpacked(Unpacker& unpacker, const std::string& bytes, std::size_t piece) {
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += piece)
    text += unpacker.take(std::string_view(bytes).substr(at, piece));
  unpacker.end();
  return text + unpacker.take({});
}

std::string rows(int count) {
  std::string text = "step,landmark,value\n";
  for (int k = 0; k < count; ++k)
    text += std::to_string(k) + ",door," + std::to_string(7 * k) + "\n";
  return text;
}

TEST_P(EveryPacking, GivesTheTextHoweverItsBytesCome) {
  const std::string text = rows(9000);
  // Parts and padding behind them are one file; xz pads to whole words.
  const std::string twice = packed(text) + packed("the end\n") + std::string(4, '\0');
  for (const std::size_t piece : {1UL, 2UL, 5UL, 7UL, 1000UL, 1UL << 20}) {
    Unpacker unpacker("f");
    EXPECT_TRUE(unpacked(unpacker, twice, piece) == text + "the end\n") << piece;
    EXPECT_FALSE(unpacker.is_cut());
    EXPECT_EQ(unpacker.packing(), GetParam().name);
  }
}

TEST_P(EveryPacking, GivesNoMoreAtATimeThanIsAskedFor) {
  const std::string text = rows(9000);
  Unpacker unpacker("f");
  unpacker.feed(packed(text));
  unpacker.end();
  std::string got;
  while (const std::size_t count = unpacker.drain(got, 1000)) EXPECT_LE(count, 1000U);
  EXPECT_TRUE(got == text);
}

TEST_P(EveryPacking, GivesWhatIsThereOfBytesThatAreCut) {
  const std::string text = rows(90'000);
  const std::string whole = packed(text);
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{6}}) {
    Unpacker unpacker("f");
    const std::string got = unpacked(unpacker, whole.substr(0, size), 100);
    EXPECT_TRUE(unpacker.is_cut()) << size;
    EXPECT_TRUE(text.starts_with(got)) << size;
    if (2 * size >= whole.size()) {
      EXPECT_GT(got.size(), text.size() / 10) << size;
    }
  }
}

TEST_P(EveryPacking, IsRefusedWhereItIsDamaged) {
  const std::string whole = packed(rows(10'000));
  std::string damaged = whole;
  for (std::size_t at = 20; at < damaged.size(); ++at)
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
  for (const std::string& bytes : {damaged, whole + "these bytes are not packed"}) {
    Unpacker unpacker("f");
    EXPECT_THROW(unpacked(unpacker, bytes, 64), IoError);
  }
}

TEST_P(EveryPacking, IsRefusedWhereItSwellsBeyondAnyTable) {
  const std::string bomb = packed(std::string(std::size_t{80} << 20, '0'));
  Unpacker unpacker("f");
  EXPECT_THROW(unpacked(unpacker, bomb, 1 << 16), IoError);
}

INSTANTIATE_TEST_SUITE_P(Unpacker, EveryPacking,
                         ::testing::Values(Packing{"gzip", test::gzipped},
                                           Packing{"xz", test::xzipped}),
                         [](const auto& test) { return test.param.name; });

TEST(Unpacker, PassesWhatIsNotPacked) {
  const std::string text = rows(9000);
  for (const std::string& bytes :
       {text, std::string(), std::string("\x1f"), std::string("\x1f,1\n"), std::string("\3757zX"),
        std::string("\3757zX\n1,2\n")})
    for (const std::size_t piece : {1UL, 3UL, 1000UL}) {
      Unpacker unpacker("f");
      EXPECT_TRUE(unpacked(unpacker, bytes, piece) == bytes);
      EXPECT_FALSE(unpacker.is_cut());
      EXPECT_EQ(unpacker.packing(), "");
    }
}

}  // namespace
}  // namespace mapproof
