#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <libdeflate.h>

#include "render/image/png.hpp"
#include "reports/diff/images/image_diff.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

std::string big_endian_bytes(std::uint32_t value) {
  std::string out;
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(value >> shift);
  return out;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian_bytes(static_cast<std::uint32_t>(data.size())) + type + data +
         big_endian_bytes(libdeflate_crc32(0, (type + data).data(), data.size() + 4));
}

std::string deflated(const std::string& bytes) {
  libdeflate_compressor* compressor = libdeflate_alloc_compressor(1);
  std::string out(libdeflate_zlib_compress_bound(compressor, bytes.size()), '\0');
  out.resize(
      libdeflate_zlib_compress(compressor, bytes.data(), bytes.size(), out.data(), out.size()));
  libdeflate_free_compressor(compressor);
  return out;
}

/// A PNG file of grey pixels, 8 bits, with such a header and such rows.
std::string png_of(std::uint32_t width, std::uint32_t height, const std::string& compressed,
                   const std::string& before_rows = "") {
  return "\x89PNG\r\n\x1A\n" +
         chunk("IHDR", big_endian_bytes(width) + big_endian_bytes(height) +
                           std::string("\x08\x00\x00\x00\x00", 5)) +
         before_rows + chunk("IDAT", compressed) + chunk("IEND", "");
}

struct Bad {
  std::string name, bytes, reason;
};

std::vector<Bad> bad_images() {
  const std::string good = png_of(4, 2, deflated(std::string(10, '\0')));
  std::string wrong_sum = good;
  wrong_sum[good.size() - 20] ^= 1;
  const std::string bomb = deflated(std::string(std::size_t{1} << 24, '\0'));
  std::string deep = "<svg xmlns='http://www.w3.org/2000/svg'>";
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  return {
      {"zero bytes", "", "is empty"},
      {"not an image", "MThd", "not an image of a format that is compared"},
      {"truncated", good.substr(0, good.size() - 15), "truncated"},
      {"signature alone", good.substr(0, 8), "truncated"},
      {"checksum", wrong_sum, "checksum"},
      {"trailing", good + "x", "nothing may follow IEND"},
      {"huge header", png_of(100000, 100000, deflated("")), "more than"},
      {"more than 2^28 pixels", png_of(20'000, 20'000, deflated("")),
       "20000 x 20000 pixels are more than the 268435456 that are read"},
      {"large header, few bytes", png_of(8000, 8000, deflated("ab")), "cannot be in"},
      {"wide header", png_of(2'000'000, 100, deflated("")), "more than"},
      {"no pixels", png_of(0, 5, deflated("")), "not a PNG header"},
      {"bomb behind a small header", png_of(4, 2, bomb), "more than its header says"},
      {"too few rows", png_of(4, 2, deflated(std::string(7, '\0'))), "fewer"},
      {"unknown filter", png_of(4, 2, deflated(std::string(10, '\x07'))), "filter"},
      {"rows that are not deflate", png_of(4, 2, "abcdefgh"), "damaged"},
      {"nested svg", deep, "nested"},
      {"svg with a script", "<svg><script/></svg>", "script"},
      {"svg with entities", "<!DOCTYPE svg [<!ENTITY a 'b'>]><svg>&a;</svg>", "declares"},
  };
}

TEST(BadImages, EachIsUnreadableWithItsReasonAndNoOtherHarm) {
  const TemporaryFolder folder;
  const auto good = folder.file("good.png", png_of(4, 2, deflated(std::string(10, '\0'))));
  ASSERT_EQ(image_diff(good, good).state, ImageState::kIdentical);
  for (const Bad& bad : bad_images()) {
    const auto path = folder.file("bad", bad.bytes);
    for (const bool is_first : {true, false}) {
      const ImageDiff found = is_first ? image_diff(path, good) : image_diff(good, path);
      if (bad.name.find("svg") == std::string::npos || found.state != ImageState::kDifferent) {
        EXPECT_EQ(found.state, ImageState::kUnreadable) << bad.name;
        EXPECT_NE(found.reason.find(bad.reason), std::string::npos)
            << bad.name << ": " << found.reason;
      }
    }
    const ImageDiff same = image_diff(path, path);
    EXPECT_TRUE(same.state == ImageState::kUnreadable || same.state == ImageState::kIdentical);
    if (bad.name.find("svg") != std::string::npos) {
      EXPECT_NE(same.reason.find(bad.reason), std::string::npos) << bad.name << ": " << same.reason;
    }
  }
}

TEST(BadImages, BesideOneThatCannotBeReadTheRowsOfALargeOneAreNotAsked) {
  const TemporaryFolder folder;
  const std::string good = png_of(4, 2, deflated(std::string(10, '\0')));
  const auto cut = folder.file("cut.png", good.substr(0, good.size() - 15));
  // More pixels than are held at once, in rows that are none.
  const auto large = folder.file("large.png", png_of(16'000, 16'000, std::string(300'000, 'x')));
  for (const ImageDiff& found : {image_diff(cut, large), image_diff(large, cut)}) {
    EXPECT_EQ(found.state, ImageState::kUnreadable);
    EXPECT_NE(found.reason.find("truncated"), std::string::npos) << found.reason;
    EXPECT_EQ(found.reason.find("more than"), std::string::npos) << found.reason;
  }
}

TEST(BadImages, ABombOfTextIsNotInflatedAndOneOfAProfileIsAnotherProfile) {
  const std::string bomb = deflated(std::string(std::size_t{1} << 24, 'a'));
  const TemporaryFolder folder;
  const std::string rows = deflated(std::string(10, '\0'));
  const auto a =
      folder.file("a.png", png_of(4, 2, rows, chunk("zTXt", std::string("k\0\0", 3) + bomb)));
  const auto b = folder.file("b.png", png_of(4, 2, rows));
  EXPECT_EQ(image_diff(a, b).state, ImageState::kIdentical);
  const auto c =
      folder.file("c.png", png_of(4, 2, rows, chunk("iCCP", std::string("k\0\0", 3) + bomb)));
  EXPECT_EQ(image_diff(b, c).state, ImageState::kDifferent);
}

TEST(BadImages, NoneTakesMemoryBeyondItsBytes) {
  test::skip_if_sanitized();
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> paths;
  for (const Bad& bad : bad_images()) paths.push_back(folder.file(bad.name, bad.bytes));
  const auto good = folder.file("good.png", png_of(4, 2, deflated(std::string(10, '\0'))));
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    // What the program and its threads have already, and 64 MiB.
    struct rusage used {};
    ::getrusage(RUSAGE_SELF, &used);
    struct rlimit limit {};
    limit.rlim_cur = limit.rlim_max =
        static_cast<rlim_t>(used.ru_maxrss) * 1024 + (rlim_t{64} << 20);
    ::setrlimit(RLIMIT_DATA, &limit);
    int wrong = 0;
    for (const auto& path : paths) try {
        wrong += image_diff(path, good).state == ImageState::kIdentical;
      } catch (const std::exception&) {
        ++wrong;
      }
    ::_exit(wrong);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace mapproof::test
