#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/errors.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/json/json_text.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

using test::error_of;

std::string parse_error(const std::string& text) {
  return error_of([&] { parse_json(text, "f.json"); });
}

TEST(JsonParser, TellsLineAndColumnOfWhatIsNoJson) {
  EXPECT_EQ(
      parse_error("{\n  \"a\" 1}"),
      "f.json: line 2, column 7: not JSON: unexpected number literal; expected ':', near \"1\"");
}

TEST(JsonParser, SaysThatATruncatedFileIsTruncated) {
  for (const char* text : {"{", "[1, 2", "[1,\n 2, tr", "{\"a\": \"b", "{\"a\": 1.", "[\"\\u12"})
    EXPECT_NE(parse_error(text).find("the file is truncated"), std::string::npos) << text;
  EXPECT_EQ(parse_error("[1,\n 2"),
            "f.json: line 2, column 3: the file is truncated: it ends "
            "within a value");
}

TEST(JsonParser, DoesNotCallATruncatedFileWhatIsIncrementalByMore) {
  EXPECT_EQ(parse_error("[1]]").find("truncated"), std::string::npos);
}

TEST(JsonParser, RefusesRepeatedKeys) {
  EXPECT_EQ(parse_error("{\"a\": 1,\n \"a\": 2}"),
            "f.json: line 2, column 4: the key \"a\" is there twice");
}

TEST(JsonParser, StopsAtDeepNesting) {
  EXPECT_EQ(parse_error(std::string(1'000'000, '[')),
            "f.json: line 1, column 65: nested deeper than 64 levels");
}

TEST(JsonTree, HoldsSoManyValuesAndNoMore) {
  const auto list_of = [](std::size_t values) {
    std::string text = "[{}";
    for (std::size_t i = 2; i < values; ++i) text += ",{}";
    return text + "]";
  };
  EXPECT_EQ(parse_json(list_of(1000), "f.json").tree().size(), 999U);
  const JsonDocument most = parse_json(list_of(kMostJsonTreeValues + 1), "f.json");
  EXPECT_EQ(test::error_of([&] { most.tree(); }),
            "f.json: holds 4000001 values of JSON; at most 4000000 are read as a table, compared or "
            "merged");
}

TEST(JsonParser, GivesOneShortLineForANumberOfAMillionDigits) {
  const std::string error = parse_error("[" + std::string(1'000'000, '9') + "]");
  EXPECT_NE(error.find("is beyond what a double holds"), std::string::npos);
  EXPECT_LT(error.size(), 150U);
  EXPECT_LT(parse_error("[1" + std::string(1'000'000, '0') + "x]").size(), 200U);
}

TEST(JsonParser, RefusesWhatIsNoText) {
  EXPECT_EQ(parse_error(""), "f.json: is empty");
  EXPECT_EQ(parse_error(" \n"), "f.json: is empty");
  EXPECT_EQ(parse_error("[\n\"\xFF\"]"), "f.json: line 2: byte 0xFF is not UTF-8");
  EXPECT_EQ(parse_error("[\"\xED\xA0\x80\"]"), "f.json: line 1: byte 0xED is not UTF-8");
  EXPECT_EQ(parse_error(std::string("[1]\n\0[2]", 8)),
            "f.json: line 2: holds a NUL byte: not a text file");
  EXPECT_EQ(parse_error(std::string("\xFF\xFE[\0", 4)), "f.json: is UTF-16; save it as UTF-8");
}

TEST(JsonParser, ReadsBehindAByteOrderMark) {
  EXPECT_EQ(parse_json("\xEF\xBB\xBF[1]", "f.json").tree().dump(), "[1]");
}

TEST(JsonCursor, NamesFilePlaceAndBounds) {
  const JsonDocument document = parse_json(R"({"a": [1, 1e9, "x"], "b/~": {}})", "f.json");
  const JsonCursor array = document.cursor().at("a");
  EXPECT_EQ(error_of([&] { array.element(1).integer(1, 1'000'000); }),
            "f.json: /a/1: expected an integer from 1 to 1000000, got 1000000000");
  EXPECT_EQ(error_of([&] { array.element(2).number(0.0, 1.5); }),
            "f.json: /a/2: expected a number from 0 to 1.5, got \"x\"");
  EXPECT_EQ(error_of([&] { document.cursor().at("b/~").boolean(); }),
            "f.json: /b~1~0: expected true or false, got an object");
  EXPECT_EQ(error_of([&] { document.cursor().at("c"); }), "f.json: /: lacks the key \"c\"");
}

TEST(JsonCursor, FindsItsWayAmongEmptyContainers) {
  const JsonDocument document = parse_json(
      R"({"a": [ ], "b": {"c": [[], [2], { }, 1, [[]]], "d": {}}, "e": [{"f":[]}], "g": 7})", "f");
  const JsonCursor root = document.cursor();
  const auto pointer = [&](const JsonCursor& json) { return error_of([&] { json.boolean(); }); };
  const JsonCursor c = root.at("b").at("c");
  EXPECT_EQ(c.size(), 5U);
  for (const JsonCursor& empty : {root.at("a"), c.element(0), c.element(2), root.at("b").at("d"),
                                  c.element(4).element(0)})
    EXPECT_EQ(empty.size(), 0U);
  EXPECT_TRUE(root.at("a").elements().empty());
  EXPECT_TRUE(root.at("b").at("d").members().empty());
  EXPECT_EQ(c.element(1).element(0).integer(0, 9), 2);
  EXPECT_EQ(root.at("g").integer(0, 9), 7);
  EXPECT_TRUE(pointer(root.at("a")).starts_with("f: /a: "));
  EXPECT_TRUE(pointer(c.element(2)).starts_with("f: /b/c/2: "));
  EXPECT_TRUE(pointer(c.element(3)).starts_with("f: /b/c/3: "));
  EXPECT_TRUE(pointer(c.element(4).element(0)).starts_with("f: /b/c/4/0: "));
  EXPECT_TRUE(pointer(root.at("e").element(0).at("f")).starts_with("f: /e/0/f: "));
  EXPECT_EQ(parse_json("{}", "f").cursor().size(), 0U);
  EXPECT_EQ(error_of([] { parse_json(R"({"a": [], "b": {}, "a": 1})", "f"); }),
            "f: line 1, column 22: the key \"a\" is there twice");
}

TEST(JsonCursor, AsksWhetherANearbyKeyWasMeant) {
  const JsonDocument document = parse_json(R"({"landmarcks": 1})", "f.json");
  EXPECT_EQ(error_of([&] {
              document.cursor().allow_only({"side_m", "landmarks"});
            }),
            "f.json: /: unknown key \"landmarcks\": did you mean \"landmarks\"?");
  EXPECT_EQ(error_of([&] { document.cursor().allow_only({"seed"}); }),
            "f.json: /: unknown key \"landmarcks\"");
}

TEST(JsonCursor, TakesAnIntegerHoweverItIsWritten) {
  const JsonDocument document = parse_json("[5.0, 1e3, 5.5, 18446744073709551615, -3]", "f.json");
  const JsonCursor array = document.cursor();
  EXPECT_EQ(array.element(0).integer(0, 10), 5);
  EXPECT_EQ(array.element(1).integer(0, 1000), 1000);
  EXPECT_THROW(array.element(2).integer(0, 10), IoError);
  EXPECT_THROW(array.element(3).integer(0, 10), IoError);
  EXPECT_EQ(array.element(3).unsigned_integer(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_THROW(array.element(4).unsigned_integer(), IoError);
}

TEST(JsonCursor, KeepsControlCharactersOfAHostileKeyOutOfItsError) {
  const JsonDocument document = parse_json("{\"a\\u001b[31m\\u202e\": 1}", "f.json");
  const std::string error = error_of([&] { document.cursor().allow_only({"b"}); });
  EXPECT_EQ(error.find('\x1b'), std::string::npos);
  EXPECT_EQ(error.find("\xE2\x80\xAE"), std::string::npos);
}

TEST(JsonCursor, RefusesAnotherSchemaAnotherVersionOrNone) {
  const auto check = [](const std::string& text) {
    return error_of([&] { expect_schema(parse_json(text, "f").cursor(), "mapproof.run"); });
  };
  EXPECT_EQ(check(R"({"schema": {"name": "mapproof.run", "version": 1}})"), "no error");
  EXPECT_EQ(check(R"({"schema": {"name": "mapproof.map", "version": 1}})"),
            "f: /schema/name: expected \"mapproof.run\", got \"mapproof.map\"");
  EXPECT_EQ(check(R"({"schema": {"name": "mapproof.run", "version": 2}})"),
            "f: /schema/version: version 2 is not known to this program, which reads version 1");
  EXPECT_NE(check("{}").find("does not state its format"), std::string::npos);
  EXPECT_NE(check("[1]").find("does not state its format"), std::string::npos);
}

TEST(JsonText, PutsAPointOnALineAndKeepsTheOrderOfKeys) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (int i = 0; i < 12; ++i) points.push_back({i + 0.5, -i - 0.25});
  const std::string text = json_text({{"z", 1}, {"points", points}, {"a", {{"b", nullptr}}}});
  EXPECT_EQ(text.substr(0, 48), "{\n  \"z\": 1,\n  \"points\": [\n    [0.5, -0.25],\n    ");
  EXPECT_TRUE(text.ends_with("    [11.5, -11.25]\n  ],\n  \"a\": {\"b\": null}\n}\n")) << text;
}

TEST(JsonText, KeepsAStringOnItsLineHoweverLong) {
  const std::string text(500, 'a');
  EXPECT_EQ(json_text({{"b", {{"c", text}}}}),
            "{\n  \"b\": {\n    \"c\": \"" + text + "\"\n  }\n}\n");
  EXPECT_EQ(json_text(text), "\"" + text + "\"\n");
}

TEST(JsonText, WritesNumbersThatAreReadBackExactly) {
  const nlohmann::ordered_json numbers = {0.1,  1.0 / 3.0, 5e-324, 1.7976931348623157e308,
                                          -0.0, 3.0};
  EXPECT_EQ(json_line(numbers),
            "[0.1, 0.3333333333333333, 5e-324, 1.7976931348623157e+308, -0.0, 3]\n");
  const auto back = parse_json(json_line(numbers), "f").tree();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(back[i].get<double>(), numbers[i].get<double>());
  EXPECT_TRUE(std::signbit(back[4].get<double>()));
}

/// Any value: strings of any bytes below 0x80 and any length, numbers, and nests of them.
nlohmann::ordered_json any_value(int depth) {
  switch (*rc::gen::inRange(0, depth > 0 ? 7 : 5)) {
    case 0:
      return nullptr;
    case 1:
      return *rc::gen::arbitrary<bool>();
    case 2:
      return *rc::gen::arbitrary<std::int64_t>();
    case 3:
      return std::ldexp(*rc::gen::arbitrary<double>(), *rc::gen::inRange(-300, 300));
    case 4:
      return std::string(*rc::gen::inRange<std::size_t>(0, 150), *rc::gen::inRange('\1', '\x7F'));
    case 5: {
      nlohmann::ordered_json array = nlohmann::ordered_json::array();
      for (int i = *rc::gen::inRange(0, 6); i > 0; --i) array.push_back(any_value(depth - 1));
      return array;
    }
    default: {
      nlohmann::ordered_json object = nlohmann::ordered_json::object();
      for (int i = *rc::gen::inRange(0, 6); i > 0; --i)
        object[std::string(1 + i, *rc::gen::inRange('\1', '\x7F'))] = any_value(depth - 1);
      return object;
    }
  }
}

RC_GTEST_PROP(JsonText, IsReadBackAsTheValueItWasMadeFrom, ()) {
  const nlohmann::ordered_json value = any_value(4);
  RC_ASSERT(parse_json(json_text(value), "f").tree() == nlohmann::json(value));
  RC_ASSERT(parse_json(json_line(value), "f").tree() == nlohmann::json(value));
  RC_ASSERT(nlohmann::json::parse(json_text(value)) == nlohmann::json(value));
}

TEST(JsonText, WritesWhatIsNotFiniteAsNull) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(json_line({std::nan(""), infinity, -infinity}), "[null, null, null]\n");
}

TEST(JsonText, ReplacesBytesThatAreNotUtf8) {
  EXPECT_EQ(json_line({"a\xFFz"}), "[\"a\xEF\xBF\xBDz\"]\n");
}

}  // namespace
}  // namespace mapproof
