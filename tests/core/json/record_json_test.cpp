#include "core/json/json_document.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/base/errors.hpp"
#include "core/json/json_text.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/schemas/record_schema.hpp"
#include "tests/support/schemas/schema_problem.hpp"

namespace mapproof::fields_test {

using test::error_of;

enum class Colour { kRed, kGreen, kBlue };
enum class Fruit { kApple, kPear, kPlum, kCherry, kQuince, kFig };

EnumNames enum_names(Colour) {
  static constexpr std::array<std::string_view, 3> kNames = {"red", "green", "blue"};
  return {"colour", kNames};
}

std::string_view name(Fruit fruit) {
  constexpr std::array<std::string_view, 6> kNames = {"apple",  "pear",   "plum",
                                                      "cherry", "quince", "fig"};
  return kNames[static_cast<std::size_t>(fruit)];
}

EnumNames enum_names(Fruit) { return names_up_to(Fruit::kFig, "fruit_of_a_tree"); }

struct Span {
  double low = 0.0, high = 1.0;
  bool operator==(const Span&) const = default;
};

auto as_tuple(Span& span) { return std::tie(span.low, span.high); }

struct Round {
  double radius = 1.0;
  bool operator==(const Round&) const = default;
};

template <typename Visitor>
void fields(Visitor& v, Round& round) {
  v.tag("shape", "round");
  v.field("radius", round.radius, {.minimum = 0.0, .above_minimum = true});
}

struct Square {
  double side = 1.0;
  bool hollow = false;
  bool operator==(const Square&) const = default;
};

template <typename Visitor>
void fields(Visitor& v, Square& square) {
  v.tag("shape", "square");
  v.field("side", square.side);
  v.field("hollow", square.hollow, {.when = square.side > 1.0});
}

constexpr TextForm kWord = {"^[a-z]+$",
                            [](std::string_view text) {
                              return !text.empty() &&
                                     text.find_first_not_of("abcdefghijklmnopqrstuvwxyz") ==
                                         std::string_view::npos;
                            },
                            "lower-case letters"};

/// Some fruits have a stone, whose size is then given.
struct Basket {
  Fruit fruit = Fruit::kPlum;
  double stone = 0.0;
  int kernels = 0;
};

template <typename Visitor>
void fields(Visitor& v, Basket& basket) {
  v.field("fruit", basket.fruit, {.decides = true});
  const bool has_stone = basket.fruit == Fruit::kPlum || basket.fruit == Fruit::kCherry;
  v.field("stone", basket.stone, {.when = has_stone});
  v.field("kernels", basket.kernels, {.when = !has_stone});
}

/// A field of every type.
struct Everything {
  std::string word = "a";
  bool flag = false;
  int count = 1;
  long large = 0;
  std::uint64_t seed = 0;
  double share = 0.0;
  double whole = 0.0;
  Colour colour = Colour::kRed;
  Fruit fruit = Fruit::kApple;
  Span span;
  std::array<int, 3> corners = {};
  std::vector<double> numbers;
  std::vector<std::pair<std::string, std::string>> pairs;
  std::optional<double> perhaps;
  std::optional<Span> limits;
  std::vector<std::string> notes;
  Eigen::Vector3d location = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 2> points;
  Eigen::Matrix2d square = Eigen::Matrix2d::Identity();
  std::vector<std::variant<Round, Square>> shapes;
};

template <typename Visitor>
void fields(Visitor& v, Everything& all) {
  v.file("mapproof.everything", "A field of every type.");
  v.field("word", all.word, {.description = "One word.", .max_bytes = 20, .form = &kWord});
  v.field("flag", all.flag);
  v.field("count", all.count, {.minimum = 1, .maximum = 1e6});
  v.field("large", all.large, {.minimum = 0});
  v.field("seed", all.seed);
  v.field("share", all.share, {.minimum = 0.0, .maximum = 1.0});
  v.field("whole", all.whole, {.whole_as_integers = true});
  v.field("colour", all.colour);
  v.field("fruit", all.fruit);
  v.field("span", all.span);
  v.field("corners", all.corners, {.minimum = 0, .maximum = 9});
  v.field("numbers", all.numbers, {.nullable = true});
  v.field("pairs", all.pairs);
  v.field("perhaps", all.perhaps);
  v.field("limits", all.limits, {.key = Key::kOptional});
  v.field("notes", all.notes, {.max_items = 3, .not_empty = true, .key = Key::kIfAny});
  v.field("location", all.location);
  v.field("points", all.points, {.nullable = true});
  v.field("square", all.square);
  v.field("shapes", all.shapes);
  if (all.span.low >= all.span.high) v.refuse("span", "expected an ascending span");
}

Everything filled() {
  Everything all;
  all.whole = 1e5;
  all.numbers = {0.5, kNaN};
  all.pairs = {{"a", "b"}};
  all.notes = {"x"};
  all.points.resize(2, 2);
  all.points << 1.0, 2.0, kNaN, kNaN;
  all.shapes = {Round{2.0}, Square{3.0, true}};
  return all;
}

std::string text_of(const Everything& all) { return json_text(to_json_value(all)); }

Everything read(const std::string& text) {
  const JsonDocument document = parse_json(text, "f.json");
  return from_json_value<Everything>(document.cursor());
}

/// The error of the reader once `from` is replaced by `to` in a sound file.
std::string refusal(const std::string& from, const std::string& to) {
  std::string text = text_of(filled());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  return error_of([&] { read(text); });
}

std::string schema_refusal(const std::string& text) {
  static const nlohmann::json schema = nlohmann::json::parse(json_schema<Everything>().dump());
  return test::schema_problem_of(schema, nlohmann::json::parse(text));
}

TEST(RecordJson, WritesTheFieldsInTheirOrder) {
  EXPECT_EQ(text_of(filled()), R"({
  "schema": {"name": "mapproof.everything", "version": 1},
  "word": "a",
  "flag": false,
  "count": 1,
  "large": 0,
  "seed": 0,
  "share": 0,
  "whole": 100000,
  "colour": "red",
  "fruit": "apple",
  "span": [0, 1],
  "corners": [0, 0, 0],
  "numbers": [0.5, null],
  "pairs": [["a", "b"]],
  "perhaps": null,
  "limits": null,
  "notes": ["x"],
  "location": [0, 0, 0],
  "points": [[1, 2], null],
  "square": [[1, 0], [0, 1]],
  "shapes": [{"shape": "round", "radius": 2}, {"shape": "square", "side": 3, "hollow": true}]
}
)");
}

RC_GTEST_PROP(RecordJson, ComesBackFromItsText, ()) {
  Everything all = filled();
  all.word = *rc::gen::container<std::string>(5, rc::gen::inRange('a', '{'));
  all.flag = *rc::gen::arbitrary<bool>();
  all.count = *rc::gen::inRange(1, 1'000'001);
  all.large = *rc::gen::nonNegative<long>();
  all.seed = *rc::gen::nonNegative<std::int64_t>();  // More is beyond valijson's integers.
  all.share = *rc::gen::inRange(0, 1001) / 1000.0;
  all.whole = *rc::gen::arbitrary<double>();
  all.colour = static_cast<Colour>(*rc::gen::inRange(0, 3));
  all.fruit = static_cast<Fruit>(*rc::gen::inRange(0, 6));
  all.span.low = -*rc::gen::positive<double>();
  all.numbers = *rc::gen::arbitrary<std::vector<double>>();
  all.pairs = *rc::gen::container<std::vector<std::pair<std::string, std::string>>>(
      rc::gen::pair(rc::gen::container<std::string>(rc::gen::inRange(' ', '~')),
                    rc::gen::container<std::string>(rc::gen::inRange(' ', '~'))));
  if (*rc::gen::arbitrary<bool>()) all.perhaps = *rc::gen::arbitrary<double>();
  if (*rc::gen::arbitrary<bool>()) all.limits = Span{-1.0, *rc::gen::arbitrary<double>()};
  all.square(0, 1) = *rc::gen::arbitrary<double>();
  const std::string text = text_of(all);
  const Everything again = read(text);
  RC_ASSERT(text_of(again) == text);
  RC_ASSERT(again.numbers == all.numbers);
  RC_ASSERT(again.pairs == all.pairs);
  RC_ASSERT(again.seed == all.seed);
  RC_ASSERT(again.perhaps == all.perhaps);
  RC_ASSERT(again.limits == all.limits);
  RC_ASSERT(again.square == all.square);
  RC_ASSERT(again.shapes == all.shapes);
  RC_ASSERT(schema_refusal(text) == "");
}

TEST(RecordJson, KeepsTheGreatestSeed) {
  Everything all = filled();
  all.seed = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(read(text_of(all)).seed, all.seed);
}

TEST(RecordJson, KeepsTheDefaultOfAnOptionalKeyThatAFileLeavesOut) {
  std::string text = text_of(filled());
  text.replace(text.find("  \"limits\": null,\n  \"notes\": [\"x\"],\n"), 37, "");
  const Everything all = read(text);
  EXPECT_FALSE(all.limits);
  EXPECT_TRUE(all.notes.empty());
  EXPECT_EQ(text_of(all).find("notes"), std::string::npos);
  EXPECT_EQ(schema_refusal(text), "");
}

struct Fault {
  std::string from, to, message;
};

std::ostream& operator<<(std::ostream& out, const Fault& fault) { return out << fault.to; }

class FaultyRecord : public ::testing::TestWithParam<Fault> {};

TEST_P(FaultyRecord, IsRefusedByTheReaderWithItsPlaceAndByTheSchema) {
  const Fault& fault = GetParam();
  EXPECT_EQ(refusal(fault.from, fault.to), "f.json: " + fault.message);
  std::string text = text_of(filled());
  text.replace(text.find(fault.from), fault.from.size(), fault.to);
  EXPECT_NE(schema_refusal(text), "");
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryKind, FaultyRecord,
    ::testing::Values(
        Fault{"\"flag\"", "\"flagg\"", "/: unknown key \"flagg\": did you mean \"flag\"?"},
        Fault{"\"flag\": false,", "", "/: lacks the key \"flag\""},
        Fault{"mapproof.everything", "mapproof.run",
              "/schema/name: expected \"mapproof.everything\", got \"mapproof.run\""},
        Fault{"\"word\": \"a\"", "\"word\": \"A1\"",
              "/word: expected lower-case letters, got \"A1\""},
        Fault{"\"word\": \"a\"", "\"word\": \"aaaaaaaaaaaaaaaaaaaaa\"",
              "/word: expected a string of at most 20 bytes, got 21"},
        Fault{"\"word\": \"a\"", "\"word\": 3", "/word: expected a string, got 3"},
        Fault{"\"flag\": false", "\"flag\": 0", "/flag: expected true or false, got 0"},
        Fault{"\"count\": 1", "\"count\": 0",
              "/count: expected an integer from 1 to 1000000, got 0"},
        Fault{"\"count\": 1", "\"count\": 1.5",
              "/count: expected an integer from 1 to 1000000, got 1.5"},
        Fault{"\"seed\": 0", "\"seed\": -1",
              "/seed: expected an integer from 0 to 18446744073709551615, got -1"},
        Fault{"\"share\": 0", "\"share\": 2", "/share: expected a number from 0 to 1, got 2"},
        Fault{"\"share\": 0", "\"share\": null", "/share: expected a number from 0 to 1, got null"},
        Fault{"\"whole\": 100000", "\"whole\": \"x\"", "/whole: expected a number, got \"x\""},
        Fault{"\"red\"", "\"rot\"", "/colour: expected red, green or blue, got \"rot\""},
        Fault{"\"apple\"", "\"apples\"",
              "/fruit: unknown fruit of a tree \"apples\": did you mean \"apple\"?"},
        Fault{"\"span\": [0, 1]", "\"span\": [0]", "/span: expected at least 2 elements, got 1"},
        Fault{"\"corners\": [0, 0, 0]", "\"corners\": [0, 0, 10]",
              "/corners/2: expected an integer from 0 to 9, got 10"},
        Fault{"[0.5, null]", "[0.5, \"x\"]", "/numbers/1: expected a number, got \"x\""},
        Fault{"[[\"a\", \"b\"]]", "[[\"a\", 1]]", "/pairs/0/1: expected a string, got 1"},
        Fault{"[\"x\"]", "[\"\"]", "/notes/0: is empty"},
        Fault{"[\"x\"]", "[\"x\", \"x\", \"x\", \"x\"]",
              "/notes: expected at most 3 elements, got 4"},
        Fault{"\"location\": [0, 0, 0]", "\"location\": [0, 0]",
              "/location: expected 3 elements, got 2"},
        Fault{"\"location\": [0, 0, 0]", "\"location\": [0, 0, null]",
              "/location/2: expected a number, got null"},
        Fault{"[[1, 2], null]", "[[1, null], null]", "/points/0/1: expected a number, got null"},
        Fault{"[[1, 0], [0, 1]]", "[[1, 0]]", "/square: expected at least 2 elements, got 1"},
        Fault{"\"radius\": 2", "\"radius\": 0",
              "/shapes/0/radius: expected a number above 0, got 0"},
        Fault{"\"round\"", "\"rund\"", "/shapes/0/shape: expected round or square, got \"rund\""},
        Fault{"\"radius\": 2", "\"side\": 2", "/shapes/0: unknown key \"side\""}));

TEST(RecordJson, RefusesAKeyThatDoesNotGoWithTheOthers) {
  EXPECT_EQ(refusal("\"side\": 3", "\"side\": 1"), "f.json: /shapes/1: unknown key \"hollow\"");
}

TEST(RecordJson, RefusesWhatACheckRefuses) {
  EXPECT_EQ(refusal("\"span\": [0, 1]", "\"span\": [1, 0]"),
            "f.json: /span: expected an ascending span");
}

TEST(RecordJson, SchemaDescribesAndDefines) {
  const auto schema = json_schema<Everything>();
  EXPECT_EQ(schema["title"], "mapproof.everything, version 1");
  EXPECT_EQ(schema["properties"]["word"]["description"], "One word.");
  EXPECT_EQ(schema["properties"]["colour"]["$ref"], "#/definitions/colour");
  EXPECT_EQ(schema["definitions"]["round"]["properties"]["shape"]["const"], "round");
}

/// Whether the reader takes it; the schema has to agree.
template <typename T>
bool is_taken(const std::string& text) {
  static const nlohmann::json schema = nlohmann::json::parse(json_schema<T>().dump());
  const JsonDocument document = parse_json(text, "f.json");
  const bool is_read = error_of([&] { from_json_value<T>(document.cursor()); }) == "no error";
  EXPECT_EQ(test::schema_problem_of(schema, document.tree()) == "", is_read) << text;
  return is_read;
}

TEST(RecordJson, SchemaHoldsKeysToTheFieldThatDecides) {
  EXPECT_TRUE(is_taken<Basket>(R"({"fruit": "plum", "stone": 0.5})"));
  EXPECT_TRUE(is_taken<Basket>(R"({"fruit": "pear", "kernels": 5})"));
  EXPECT_FALSE(is_taken<Basket>(R"({"fruit": "cherry"})"));
  EXPECT_FALSE(is_taken<Basket>(R"({"fruit": "cherry", "kernels": 5})"));
  EXPECT_FALSE(is_taken<Basket>(R"({"fruit": "cherry", "stone": 1, "kernels": 5})"));
  EXPECT_FALSE(is_taken<Basket>(R"({"fruit": "apple"})"));
}

/// Keys that a file chooses itself, or may leave out, and arrays within bounds.
struct Freedom {
  std::map<std::string, std::vector<double>> numbers;
  std::vector<int> steps;
  std::vector<std::vector<Colour>> orders;
  std::string word = "a", label;
  std::optional<double> left, right;
};

constexpr std::array<std::string_view, 2> kKnownWords = {"a", "b"};
constexpr FieldRule kOrder = {.unique = true, .min_items = 2};

template <typename Visitor>
void fields(Visitor& v, Freedom& freedom) {
  v.field("numbers", freedom.numbers,
          {.integer = true, .or_one = true, .min_items = 1, .max_keys = 2});
  v.field("steps", freedom.steps, {.ascending = true});
  v.field("orders", freedom.orders, {.items = &kOrder});
  v.field("word", freedom.word, {.decides = true, .known = kKnownWords});
  const bool is_known = std::ranges::find(kKnownWords, freedom.word) != kKnownWords.end();
  v.field("label", freedom.label, {.key = is_known ? Key::kOptional : Key::kRequired});
  const auto sides = [&](auto& side) {
    side.key_count(1, 1);
    side.field("left", freedom.left, {.key = Key::kIfAny});
    side.field("right", freedom.right, {.key = Key::kIfAny});
  };
  v.group("sides", sides, {.key = Key::kOptional, .written = freedom.left || freedom.right});
}

TEST(RecordJson, TakesKeysThatFilesChooseAndHoldsArraysToTheirBounds) {
  const auto text = [](const std::string& from = "{", const std::string& to = "{") {
    std::string sound = R"({"numbers": {"x": 3, "y": [1, 2]}, "steps": [1, 4], "orders":)"
                        R"( [["red", "blue"]], "word": "b", "sides": {"left": 1}})";
    return sound.replace(sound.find(from), from.size(), to);
  };
  EXPECT_TRUE(is_taken<Freedom>(text()));
  EXPECT_TRUE(is_taken<Freedom>(text("\"b\"", "\"c\", \"label\": \"C\"")));
  EXPECT_TRUE(is_taken<Freedom>(text(", \"sides\": {\"left\": 1}", "")));
  EXPECT_FALSE(is_taken<Freedom>(text("\"b\"", "\"c\"")));
  EXPECT_FALSE(is_taken<Freedom>(text("[1, 2]", "[]")));
  EXPECT_FALSE(is_taken<Freedom>(text("[1, 2]", "[1.5]")));
  EXPECT_FALSE(is_taken<Freedom>(text("\"x\": 3", "\"x\": 3, \"z\": 3")));
  EXPECT_FALSE(is_taken<Freedom>(text("\"red\", ", "")));
  EXPECT_FALSE(is_taken<Freedom>(text("red", "blue")));
  EXPECT_FALSE(is_taken<Freedom>(text("\"left\": 1", "")));
  EXPECT_FALSE(is_taken<Freedom>(text("\"left\": 1", "\"left\": 1, \"right\": 1")));
  const JsonDocument document = parse_json(text("[1, 4]", "[4, 1]"), "f.json");
  EXPECT_EQ(error_of([&] { from_json_value<Freedom>(document.cursor()); }),
            "f.json: /steps/1: expected values in ascending order, got 1 after 4");
}

TEST(RecordJson, NamesTheFirstItemThatIsThereTwice) {
  const std::string text =
      R"({"numbers": {}, "steps": [], "orders": [["blue", "red", "green", "red", "blue"]],)"
      R"( "word": "a"})";
  const JsonDocument document = parse_json(text, "f.json");
  EXPECT_EQ(error_of([&] { from_json_value<Freedom>(document.cursor()); }),
            "f.json: /orders/0/3: is there twice: at /orders/0/1 before");
}

TEST(RecordJson, WritesAMapKeyByKeyAndLeavesOutAGroupThatIsNotThere) {
  Freedom freedom;
  freedom.numbers["x"] = {1.0, 2.0};
  EXPECT_EQ(to_json_value(freedom).dump(),
            R"({"numbers":{"x":[1,2]},"steps":[],"orders":[],"word":"a","label":""})");
  freedom.left = 0.5;
  EXPECT_EQ(to_json_value(freedom)["sides"].dump(), R"({"left":0.5})");
}

TEST(JsonText, FlattenedNamesEveryValueByItsPointer) {
  const auto flat = flattened(to_json_value(filled()));
  const std::map<std::string, std::string> values(flat.begin(), flat.end());
  EXPECT_EQ(values.at("/schema/name"), "\"mapproof.everything\"");
  EXPECT_EQ(values.at("/numbers"), "[0.5,null]");
  EXPECT_EQ(values.at("/shapes/1/side"), "3.0");
  EXPECT_EQ(flat.front().first, "/schema/name");
}

}  // namespace mapproof::fields_test
