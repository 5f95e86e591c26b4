#include "core/base/files/byte_source.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/byte_sources.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::error_of;
using test::source_of;

/// Some 1.7 MB that hardly repeat.
const std::string& sample() {
  static const std::string bytes = [] {
    std::string text;
    for (int i = 0; i < 250'000; ++i) text += std::to_string(i * 7919LL % 1'000'003) + '\n';
    return text;
  }();
  return bytes;
}

/// The same bytes in every packing.
std::vector<std::string> packings(const std::string& bytes) {
  return {bytes, test::gzipped(bytes), test::xzipped(bytes)};
}

const std::vector<std::string>& samples() {
  static const std::vector<std::string> packed = packings(sample());
  return packed;
}

TEST(ByteSource, GivesATextOfWindows1252AsUtf8HoweverItsBytesCome) {
  for (const std::size_t ascii : {std::size_t{0}, std::size_t{5}, std::size_t{70'000}}) {
    const std::string start(ascii, 'a');
    const std::string bytes = start + "\xFC\xDF\x80 b\xB0", text = start + "üß€ b°";
    for (const std::string& packed : packings(bytes))
      for (const std::size_t piece : {1, 3, 100'000}) {
        for (const bool is_peeked : {false, true}) {
          ByteSource source = source_of(packed, piece);
          if (is_peeked) source.peek(ascii + 1);
          source.take_text();
          EXPECT_TRUE(source.rest() == text);
          EXPECT_TRUE(source.form().ends_with("Windows-1252"));
        }
      }
  }
  for (const char* utf8 : {"a\u00FCb\u00FF", "a€b", "abc", ""}) {
    ByteSource source = source_of(utf8, 1);
    source.take_text();
    EXPECT_EQ(source.rest(), utf8);
    EXPECT_EQ(source.form(), "");
  }
  // A broken character of UTF-8 behind others stays, to be refused.
  ByteSource source = source_of("ü\xFC", 1);
  source.take_text();
  EXPECT_EQ(source.rest(), "ü\xFC");
}

// Not by EXPECT_EQ, which would look for the least edit between megabytes.

TEST(ByteSource, GivesTheSameBytesHoweverTheyComeAndArePacked) {
  for (const std::string& packed : samples())
    for (const std::size_t piece : {1UL, 7UL, 4096UL, 1UL << 20})
      EXPECT_TRUE(source_of(packed, piece).rest() == sample()) << piece;
}

TEST(ByteSource, GivesBlocksThatAreFullUpToTheEnd) {
  for (const std::string& packed : samples()) {
    ByteSource source = source_of(packed, 1000);
    std::string bytes;
    while (source.append(bytes, 70'000))
      EXPECT_TRUE(bytes.size() % 70'000 == 0 || bytes.size() == sample().size());
    EXPECT_TRUE(bytes == sample());
  }
}

TEST(ByteSource, IsReadWholeAfterItWasScanedAt) {
  for (const std::string& packed : samples()) {
    ByteSource source = source_of(packed, 333);
    EXPECT_TRUE(source.peek(10) == sample().substr(0, 10));
    EXPECT_TRUE(source.peek() == sample().substr(0, ByteSource::kPeek));
    EXPECT_TRUE(source.holds_more_than(1'500'000));
    EXPECT_FALSE(source.holds_more_than(sample().size()));
    std::string bytes;
    source.append(bytes, 100'000);
    EXPECT_TRUE(source.peek(1'200'000) == sample().substr(100'000, 1'200'000));
    EXPECT_TRUE(bytes + source.rest() == sample());
    EXPECT_TRUE(source.peek().empty());
    EXPECT_FALSE(source.holds_more_than(0));
  }
}

TEST(ByteSource, KnowsExactlyHowMuchItHolds) {
  const test::TemporaryFolder folder;
  for (const std::string& packed : samples()) {
    const auto path = folder.file("a", packed);
    EXPECT_TRUE(ByteSource(path).holds_more_than(sample().size() - 1));
    EXPECT_FALSE(ByteSource(path).holds_more_than(sample().size()));
    ByteSource source(path);
    std::string bytes;
    source.append(bytes, 200'000);
    const double reported =
        source.expected_size().value_or(0.0) / static_cast<double>(sample().size());
    EXPECT_TRUE(reported > 0.5 && reported < 2.0) << reported;
  }
  EXPECT_FALSE(source_of(sample()).expected_size());
}

TEST(ByteSource, NamesAFileWhosePackingIsCutOffOrDamaged) {
  const test::TemporaryFolder folder;
  const std::pair<std::string, std::string> kinds[] = {{"gzip", samples()[1]},
                                                       {"xz", samples()[2]}};
  for (const auto& [name, packed] : kinds) {
    const auto cut = folder.file("cut", packed.substr(0, packed.size() / 2));
    EXPECT_EQ(error_of([&] { read_input(cut); }),
              cut.string() + ": the " + name + "'ed file is cut off");
    std::string damaged = packed;
    damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
    const auto bad = folder.file("bad", damaged);
    EXPECT_TRUE(error_of([&] {
                  read_input(bad);
                }).starts_with(bad.string() + ": the " + name + "'ed file is damaged"));
  }
}

TEST(ByteSource, RefusesWhatIsLargerThanAllowed) {
  for (const std::string& packed : packings("a,b\n1,2\n")) {
    EXPECT_EQ(source_of(packed).rest(8), "a,b\n1,2\n");
    EXPECT_EQ(error_of([&] { source_of(packed).rest(7); }), "source: is larger than 7 bytes");
  }
  const std::string bomb = test::xzipped(std::string(std::size_t{80} << 20, '0'));
  EXPECT_EQ(error_of([&] { source_of(bomb).rest(); }),
            "source: unpacks to more than 300 times its size: no table does");
}

TEST(ByteSource, OfAnEmptyInputIsEmpty) {
  ByteSource source = source_of("");
  EXPECT_EQ(source.peek(), "");
  EXPECT_EQ(source.rest(), "");
}

}  // namespace
}  // namespace mapproof
