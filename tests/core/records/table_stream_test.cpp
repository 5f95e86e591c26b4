#include "core/records/tables/table_stream.hpp"

#include <gtest/gtest.h>

#include "tests/core/records/samples.hpp"
#include "tests/support/byte_sources.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::error_of;

/// All cells with their lines, as text.
std::string read_all(const std::filesystem::path& path) {
  ByteSource source(path);
  TableStream stream(source);
  TableRow row;
  std::string all;
  while (stream.next(row)) {
    all += std::to_string(row.line);
    for (const std::string_view cell : row.cells) all += '|' + std::string(cell);
    all += '\n';
  }
  return all;
}

/// The same by one reader over the whole text.
std::string read_whole(const std::string& text) {
  const std::string source = "whole";
  TableReader reader(text, source);
  TableRow row;
  std::string all;
  while (reader.next(row)) {
    all += std::to_string(row.line);
    for (const std::string_view cell : row.cells) all += '|' + std::string(cell);
    all += '\n';
  }
  return all;
}

TEST(TableStream, GivesTheRowsThatOneReaderGives) {
  const test::TemporaryFolder folder;
  std::string text = "# a comment with one \" in it\r\nname;\"x\ny\";2\r\n";
  for (int i = 0; i < 200'000; ++i) {
    text += std::to_string(i) + ";\"a \"\"quoted\"\" one";
    if (i % 1000 == 0) text += "\nover two lines";
    text += "\";" + std::to_string(i % 97) + "\r\n";
    if (i % 5000 == 0) text += "\n# \"\n";
  }
  EXPECT_TRUE(read_all(folder.file("a.csv", text)) == read_whole(text));
}

TEST(TableStream, TakesItsSeparatorFromTheFirstRowHoweverFarDownItIs) {  // Found by the fuzzer.
  const test::TemporaryFolder folder;
  std::string remarks;
  while (remarks.size() < (std::size_t{1} << 20)) remarks += "# a remark, and another\n";
  for (const std::string& text : {remarks + "a;b\n1;2\n", std::string("\n40\t,\"\n")})
    EXPECT_EQ(read_all(folder.file("t", text)), read_whole(text));
}

TEST(TableStream, NamesTheLineFarDownThatIsNoText) {
  const test::TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 400'000; ++i) text += "12345,6\n";
  text += "12345,\xFF\n";
  const auto path = folder.file("a.csv", text);
  EXPECT_EQ(error_of([&] { read_all(path); }),
            path.string() + ": line 400001: byte 0xFF is not UTF-8");
}

TEST(TableStream, AQuoteThatNeverEndsIsFoundInBoundedMemory) {
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.csv", "a,b\n1,\"" + std::string(std::size_t{20} << 20, 'x'));
  EXPECT_EQ(error_of([&] { read_all(path); }),
            path.string() + ": line 2: a row of more than 16 MB: do its quotes end?");
}

TEST(TableStream, ItsFirstRowIsSeenBeforeItIsRead) {
  const auto is_header = [](const TableRow& row) { return row.cells[0] == "name"; };
  std::string comments, wide = "name";
  for (int i = 0; i < 30'000; ++i) comments += "# a comment with \" in it\n";
  for (int i = 0; i < 300'000; ++i) wide += ",1";
  for (const std::string& text : {std::string("name,x\n1,2\n"), comments + "name,x\n1,2\n",
                                  wide + "\n1,2\n", wide, std::string("name,\"x\ny\"\n1,2\n")}) {
    ByteSource source = test::source_of(text, 999);
    EXPECT_TRUE(first_row_is(source, is_header));
    EXPECT_TRUE(source.rest() == text);
  }
  for (const std::string& text : {std::string("1,name\n"), comments, std::string("\n\n")}) {
    ByteSource source = test::source_of(text);
    EXPECT_FALSE(first_row_is(source, is_header));
  }
  ByteSource endless = test::source_of("name,\"" + std::string(std::size_t{70} << 20, 'x'));
  EXPECT_FALSE(first_row_is(endless, is_header));
}

TEST(RowEnds, AreTheSameInBytesThatGrow) {
  const std::string text = "a,b\n# it's \" so\n1,\"x\ny\n\"\n2,\"\"\"\n\"\n3,4\n\"5\n";
  for (std::size_t first = 0; first <= text.size(); ++first)
    for (std::size_t second = first; second <= text.size(); ++second) {
      RowEnds ends;
      ends.in(std::string_view(text).substr(0, first));
      const std::size_t grown = ends.in(std::string_view(text).substr(0, second));
      EXPECT_EQ(grown, RowEnds().in(std::string_view(text).substr(0, second)))
          << first << ", " << second;
    }
  EXPECT_EQ(RowEnds().in(text), text.size() - 3);
}

// One open quote over megabytes: each of them is searched once.
TEST(RowEnds, SearchEachByteOnce) {
  std::string text = "1,\"";
  RowEnds ends;
  for (int k = 0; k < 200; ++k) {
    text += std::string(20'000, k % 3 == 0 ? '\n' : 'x');
    EXPECT_EQ(ends.in(text), 0U);
  }
  EXPECT_EQ(ends.in(text + "\"\n"), text.size() + 2);
}

TEST(TableStream, AnEmptyFileIsAnError) {
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.csv", "");
  EXPECT_EQ(error_of([&] { read_all(path); }), path.string() + ": is empty");
}

}  // namespace
}  // namespace mapproof
