#include "core/base/packed_file.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/gzip.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::error_of;
using test::gzipped;

TEST(PackedFile, AFileReadsTheSameGzippedOrNot) {
  const test::TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 300'000; ++i) bytes += std::to_string(i % 1000 * 7919) + '\n';
  // Not by EXPECT_EQ, which would look for the least edit between megabytes.
  EXPECT_TRUE(read_packed_file(folder.file("plain.csv", bytes)) == bytes);
  EXPECT_TRUE(read_packed_file(folder.file("a.csv.gz", gzipped(bytes))) == bytes);
  EXPECT_TRUE(read_packed_file(folder.file("misnamed.csv", gzipped(bytes))) == bytes);
}

TEST(PackedFile, PartsOneBehindTheOtherAreOneFile) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_packed_file(folder.file("two.gz", gzipped("a,b\n") + gzipped("c,d\n"))),
            "a,b\nc,d\n");
}

TEST(PackedFile, OneThatIsCutOffOrDamagedSaysSo) {
  const test::TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 10'000; ++i) bytes += std::to_string(i * i % 1013) + '\n';
  const std::string packed = gzipped(bytes);
  const auto cut = folder.file("cut.gz", packed.substr(0, packed.size() / 2));
  EXPECT_EQ(error_of([&] { read_packed_file(cut); }),
            cut.string() + ": the gzip'ed file is cut off");
  std::string damaged = packed;
  damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
  const auto bad = folder.file("bad.gz", damaged);
  EXPECT_TRUE(error_of([&] {
                read_packed_file(bad);
              }).starts_with(bad.string() + ": the gzip'ed file is damaged"));
}

TEST(PackedFile, OneThatSwellsBeyondAnyTableIsRefused) {
  const test::TemporaryFolder folder;
  const auto bomb = folder.file("bomb.gz", gzipped(std::string(std::size_t{80} << 20, '0')));
  EXPECT_EQ(error_of([&] { read_packed_file(bomb); }),
            bomb.string() + ": inflates to more than 300 times its size: no table does");
}

TEST(PackedFile, AFolderAndAFileThatIsNotThereAreErrors) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(read_packed_file(folder.path()), IoError);
  EXPECT_THROW(read_packed_file(folder / "none.gz"), IoError);
}

}  // namespace
}  // namespace mapproof
