#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/random.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text/csv.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/utf8.hpp"
#include "core/base/text/words.hpp"
#include "core/base/version.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("mapproof-files-" + std::to_string(::getpid()) + "-" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(Files, WhatIsWrittenIsReadBackAndNothingElseIsLeft) {
  const std::string bytes("a\0b\n\xFF", 5);
  write_file(folder_ / "deep" / "file", bytes);
  EXPECT_EQ(read_file(folder_ / "deep" / "file"), bytes);
  write_file(folder_ / "deep" / "file", "short");
  EXPECT_EQ(read_file(folder_ / "deep" / "file"), "short");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "deep"), {}), 1);
}

TEST_F(Files, WhatIsAppendedStandsBehindWhatWasThere) {
  const OutputFolder outputs(folder_);
  outputs.append("file", "one\n");
  outputs.append("file", "");
  outputs.append("file", "two\n");
  EXPECT_EQ(read_file(folder_ / "file"), "one\ntwo\n");
  EXPECT_THROW(outputs.append("missing/file", "x"), IoError);
}

TEST_F(Files, AFullDiskLeavesTheOldFileAndNoPart) {
  write_file(folder_ / "file", "old");
  const auto full = [&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_file(folder_ / "file", std::string(100000, 'x'));
    } catch (const IoError& error) {
      std::cerr << error.what();
      std::exit(7);
    }
    std::exit(0);
  };
  EXPECT_EXIT(full(), ::testing::ExitedWithCode(7), "file: cannot be written: File too large");
  EXPECT_EQ(read_file(folder_ / "file"), "old");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, TroubleNamesTheFile) {
  const auto message = [](auto&& action) -> std::string {
    try {
      action();
    } catch (const IoError& error) {
      return error.what();
    }
    return "no error";
  };
  write_file(folder_ / "file", "12345");
  EXPECT_NE(message([&] { read_file(folder_ / "none"); }).find("none: cannot be opened"),
            std::string::npos);
  EXPECT_NE(message([&] { read_file(folder_); }).find("is a folder"), std::string::npos);
  EXPECT_NE(message([&] { read_file(folder_ / "file", 4); }).find("larger than 4 bytes"),
            std::string::npos);
  EXPECT_NE(message([&] { write_file(folder_ / "file" / "below", ""); }).find("file"),
            std::string::npos);
}

TEST(NumberText, HasNoMinusZero) {
  EXPECT_EQ(number_text(-0.001, 2), "0.00");
  EXPECT_EQ(number_text(-0.2, 1), "−0.2");
}

TEST(NumberText, HasItsThousandsApartBesideNumbersOfFiveDigits) {
  EXPECT_EQ(number_text(1204.0, 0, 9999.0), "1204");
  EXPECT_EQ(number_text(1204.0, 0, 9999.6), "1,204");  // It is shown as 10,000.
  EXPECT_EQ(number_text(12345.24, 1, 12345.24), "12,345.2");
  EXPECT_EQ(number_text(-123456.0, 0, -123456.0), "−123,456");
  EXPECT_EQ(number_text(-0.2, 0, 12345.0), "0");
  EXPECT_EQ(number_text(1e18, 0, 1e18), "1,000,000,000,000,000,000");
}

TEST(NumberText, HasThreeSignificantDigitsWithTheirZeros) {
  EXPECT_EQ(significant(0.2194), "0.219");
  EXPECT_EQ(significant(0.012), "0.0120");
  EXPECT_EQ(significant(0.1), "0.100");
  EXPECT_EQ(significant(141.4), "141");
  EXPECT_EQ(significant(1859.4), "1859");
  EXPECT_EQ(significant(17561.2), "17,561");
  EXPECT_EQ(significant(-2.1), "−2.10");
  EXPECT_EQ(significant(2.98e9), "2.98×10⁹");
  EXPECT_EQ(significant(0.0), "0");
  EXPECT_EQ(significant(std::nan("")), "unknown");
}

TEST(NumberText, CountsDigitsAfterRounding) {
  EXPECT_EQ(significant(0.09996), "0.100");
  EXPECT_EQ(significant(9.996), "10.0");
  EXPECT_EQ(significant(999999.9), "1.00×10⁶");
  EXPECT_EQ(significant(9.99e-7), "9.99×10⁻⁷");
}

TEST(NumberText, OfAnErrorSaysThatAMapDiverged) {
  EXPECT_EQ(error_text(0.12345), "0.123 m");
  EXPECT_EQ(error_text(2.3e-16), "≈ 0 m");
  EXPECT_EQ(error_text(1000.0), "1000 m");
  EXPECT_EQ(error_text(1001.0), "over 1\u00A0km");
  EXPECT_EQ(error_text(-1001.0), "below −1\u00A0km");
  EXPECT_EQ(error_text(std::nan("")), "unknown");
}

TEST(NumberText, ScalesTimesAndLengthsOfPaths) {
  EXPECT_EQ(seconds_text(2.1e-3), "2.10 ms");
  EXPECT_EQ(seconds_text(421.4e-6), "421 µs");
  EXPECT_EQ(seconds_text(0.99951), "1.00 s");
  EXPECT_EQ(seconds_text(12.0), "12.0 s");
  EXPECT_EQ(length_text(1859.0), "1.86 km");
  EXPECT_EQ(length_text(999.6), "1.00 km");
  EXPECT_EQ(length_text(86.0), "86.0 m");
}

TEST(NumberText, OfADataAttributeIsNotRoundedTwice) {
  EXPECT_EQ(data_number(0.123456789), "0.123457");
  EXPECT_EQ(data_number(0.25049996), "0.25049996");  // 0.250 with three digits, as 0.2505 is not.
  EXPECT_EQ(data_number(-1204.99999), "-1204.99999");
  EXPECT_EQ(data_number(0.2505), "0.2505");
  EXPECT_EQ(data_number(25.0), "25");
  EXPECT_EQ(data_number(NAN), "nan");
}

TEST(NumberText, OfACountHasNoDecimals) {
  EXPECT_EQ(quantity_text(20.0, ""), "20");
  EXPECT_EQ(quantity_text(20.5, ""), "20.5");
  EXPECT_EQ(quantity_text(20.0, "m"), "20.0\u00A0m");
  EXPECT_EQ(quantity_text(2.064, "\u00B0"), "2.06\u00B0");
}

TEST(Printable, ShowsWhatCannotBeSeenAndCutsWhatIsLong) {
  EXPECT_EQ(printable("plain σ²"), "plain σ²");
  EXPECT_EQ(printable("a\nb\x1B[31m"), "a\\u{000A}b\\u{001B}[31m");
  EXPECT_EQ(printable("\u202Eabc"), "\\u{202E}abc");
  EXPECT_EQ(printable("\xFF\xC0"), "\\xFF\\xC0");
  EXPECT_EQ(printable(std::string(10000, 'x'), 5), "xxxxx...");
}

TEST(Utf8, EveryCodePointComesBack) {
  for (char32_t code = 0; code <= 0x10FFFF; ++code) {
    if (code >= 0xD800 && code <= 0xDFFF) continue;
    std::string text;
    append_utf8(text, code);
    std::string_view rest = text;
    ASSERT_EQ(take_code_point(rest), code);
    ASSERT_TRUE(rest.empty());
  }
}

TEST(Utf8, WhatIsNotWellFormedIsTakenByteByByte) {
  for (const std::string_view text :
       {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xED\xBF\xBF",
        "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF", "\xE2\x82", "\xC3("}) {
    std::string_view rest = text;
    EXPECT_FALSE(take_code_point(rest)) << printable(std::string(text));
    EXPECT_EQ(rest.size(), text.size() - 1);
  }
}

TEST(Random, FollowsTheReferenceOfItsAuthors) {
  // First outputs of xoshiro256** seeded by SplitMix64(0), as every faithful port gives them.
  Random random(0);
  EXPECT_EQ(random.next(), 11091344671253066420ULL);
  EXPECT_EQ(random.next(), 13793997310169335082ULL);
}

TEST(Random, HasTheMomentsOfItsDistributions) {
  Random random(3);
  const int n = 200000;
  double sum = 0.0, squares = 0.0, uniform = 0.0;
  for (int i = 0; i < n; ++i) {
    const double z = random.normal();
    sum += z;
    squares += z * z;
    uniform += random.uniform(2.0, 4.0);
  }
  EXPECT_NEAR(sum / n, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(uniform / n, 3.0, 5.0 / std::sqrt(3.0 * n));
}

TEST(DeriveSeed, DiffersForEveryKeyAndOrder) {
  std::set<std::uint64_t> seeds{derive_seed(1, {}),     derive_seed(1, {0}),
                                derive_seed(1, {0, 0}), derive_seed(1, {1, 2}),
                                derive_seed(1, {2, 1}), derive_seed(2, {1, 2})};
  EXPECT_EQ(seeds.size(), 6U);
}

TEST(Version, IsStated) {
  EXPECT_FALSE(version().empty());
  EXPECT_FALSE(source_commit().empty());
  EXPECT_EQ(solver_digest().size(), 64U);
}

TEST(Numbers, OfFiveDigitsAndMoreHaveTheirThousandsApart) {
  EXPECT_EQ(count_text(9658), "9658");
  EXPECT_EQ(count_text(25'700), "25,700");
  EXPECT_EQ(count_text(-123'456), "\u2212123,456");
  EXPECT_EQ(count_text(1'000'000), "1,000,000");
  EXPECT_EQ(count_text(1204, 25'700), "1,204");
  EXPECT_EQ(count_text(204, 25'700), "204");
  EXPECT_EQ(count_text(1204, 9658), "1204");
  EXPECT_EQ(quantity_text(23'944.0, ""), "23,944");
}

TEST(Numbers, ThatLabelSomethingAreShortAndSmallOnesArePowersOfTen) {
  EXPECT_EQ(level_number_text(1e-6), "10⁻⁶");
  EXPECT_EQ(level_number_text(1e-4), "10⁻⁴");
  EXPECT_EQ(level_number_text(2.5e-4), "2.5×10⁻⁴");
  EXPECT_EQ(level_number_text(-1e-7), "\u221210⁻⁷");
  EXPECT_EQ(level_number_text(0.001), "0.001");
  EXPECT_EQ(level_number_text(-0.5), "\u22120.5");
  EXPECT_EQ(level_number_text(0.0), "0");
  EXPECT_EQ(level_number_text(2000.0), "2000");
  EXPECT_EQ(level_number_text(30'000.0), "30,000");
}

TEST(Words, CountAndListAsASentenceDoes) {
  EXPECT_EQ(counted(0, "run"), "0 runs");
  EXPECT_EQ(counted(1, "run"), "1 run");
  EXPECT_EQ(counted(25'700, "map"), "25,700 maps");
  EXPECT_EQ(listed({}, 3), "");
  EXPECT_EQ(listed({"a", "b", "c"}, 5), "a, b and c");
  EXPECT_EQ(listed({"a", "b", "c", "d"}, 3), "a, b and 2 more");
}

TEST(Csv, QuotesWhatAReaderCouldSplitOrStrip) {
  EXPECT_EQ(csv_field("a b"), "a b");
  EXPECT_EQ(csv_field("a,\"b\""), "\"a,\"\"b\"\"\"");
  for (const char* text : {"a;b", "a\tb", "a\nb", "#a", " a", "a "})
    EXPECT_EQ(csv_field(text).front(), '"') << text;
}

TEST(Csv, WritesNumbersThatReadBackTheSame) {
  EXPECT_EQ(csv_number(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(csv_number(100'000.0), "100000");
  EXPECT_EQ(csv_number(std::nan("")), "");
}

TEST(Sha256, OfThreeLettersIsThatOfTheStandard) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Words, AreTrimmedOfWhatIsNamed) {
  EXPECT_EQ(trimmed(" \t a b \r"), "a b");
  EXPECT_EQ(trimmed("\n a \n"), "\n a \n");
  EXPECT_EQ(trimmed("\n a\n b\f\v\n", kWhiteSpace), "a\n b");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(lower_case("ABC xyz \u00C4 1"), "abc xyz \u00C4 1");
  EXPECT_EQ(capitalised("to a sentence"), "To a sentence");
  for (const char* text : {"", "ISOMAP", "3-D", "\u00E4"}) EXPECT_EQ(capitalised(text), text);
}

}  // namespace
}  // namespace mapproof
