#include "app/map/option_table.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <ranges>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include "app/map/arguments.hpp"
#include "core/base/errors.hpp"
#include "tests/support/program.hpp"

namespace mapproof {
namespace {

using Words = std::vector<std::string>;

/// Words that fulfil a condition, an option of the table without an example of its own.
const std::map<std::string_view, Words> kFulfilling = {
    {"--sensor", {"--sensor", "bearing"}},
    {"a method with a parameter", {"--method", "isomap"}},
    {"a method with K", {"--method", "isomap"}},
    {"a method with sigma2", {"--method", "kpca-gaussian"}},
    {"a method with d", {"--method", "kpca-polynomial"}},
    {"a method of references", {"--method", "landmark-isomap"}},
    {"a method of least stress", {"--method", "smacof"}},
    {"a --with-sensor for each", {"--with-sensor", "bearing"}},
    {"--sensor with bearings", {"--sensor", "bearing"}},
    {"--missing ppca, pca or auto", {"--missing", "ppca"}},
    {"--find-moved without range-bearing", {"--find-moved"}},
};

/// Words with which a condition is not fulfilled that holds without any words.
const std::map<std::string_view, Words> kFailing = {
    {"a method with a parameter", {"--method", "lpca"}},
    {"a method with K", {"--method", "lpca"}},
    {"--sensor with bearings", {"--sensor", "range"}},
};

/// Options that go with every other option. --truth is short for --ground-truth.
const std::set<std::string> kFree = {"--out",  "--jobs", "--force", "--provenance", "--truth",
                                     "--help", "--json", "--quiet", "--verbose"};

/// The parser of `mapproof map`, with the job that it fills in.
struct Parser {
  CLI::App app;
  MapJob job;

  Parser() {
    add_map_options(app, job);
    complete_help(app);
  }
};

const MapOption& option_named(std::string_view name) {
  const auto options = map_option_table().options;
  const auto found = std::ranges::find(options, name, &MapOption::name);
  if (found == options.end()) throw InvalidInput("no option " + std::string(name));
  return *found;
}

bool is_condition(const MapOption& option) { return option.example.empty(); }

/// Words that ask for an option or fulfil a condition; with a file or folder where one is needed.
Words words_of(const MapOption& option) {
  Words words = is_condition(option) ? kFulfilling.at(option.name) : option.example;
  Parser parser;
  if (words.size() == 1 && parser.app.get_option(words[0])->get_items_expected_min() > 0)
    words.emplace_back("known.csv");
  return words;
}

Words operator+(Words first, const Words& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// The job that the program makes of these words. @throws CLI::ParseError.
MapJob job_of(const Words& words) {
  Words all = Words{"rows.csv", "--out", "map"} + words;
  std::ranges::reverse(all);  // CLI11 takes them from the back.
  Parser parser;
  parser.app.parse(all);
  return parser.job;
}

bool is_in_parameter_group(const std::string& word) {
  const std::set<std::string> group = {"--parameter", "--neighbours", "--sigma2", "--degree"};
  return group.contains(word);
}

/// Whether both options set the same thing: the parser takes only one of them.
bool are_alternatives(const Words& first, const Words& second) {
  return first[0] == second[0] ||
         (is_in_parameter_group(first[0]) && is_in_parameter_group(second[0]));
}

/// The sentence by which require_compatible() refuses a job, equal to refusal(); empty: accepted.
std::string said_of(const MapJob& job) {
  std::string thrown;
  try {
    require_compatible(job);
  } catch (const InvalidInput& error) {
    thrown = error.what();
  }
  EXPECT_EQ(thrown, refusal(job));
  return thrown;
}

/// "--missing" of "--missing ppca, pca or auto", "--with-sensor" of "a --with-sensor for each".
std::string option_word(std::string_view name) {
  const std::size_t begin = name.find('-');
  if (begin == std::string_view::npos) return "";
  return std::string(name.substr(begin, name.find(' ', begin) - begin));
}

std::string line_of(const Words& words) { return fmt::format("{}", fmt::join(words, " ")); }

/// Two options on one command line, with the words that the table of needs asks for in addition.
class Combination {
 public:
  Combination(const MapOption& first, const MapOption& second) {
    add(first);
    add(second);
    for (const OptionPair& need : map_option_table().needed | std::views::reverse)
      if (has(need.option) && !has(need.other)) add_if_free(option_named(need.other));
  }

  const Words& words() const { return words_; }
  const MapJob& job() const { return job_; }

  /// Whether the words ask for that option: by the example of one option alone, or, of a
  /// condition, all together.
  bool has(std::string_view name) const {
    const MapOption& option = option_named(name);
    return is_condition(option) ? option.is_asked(job_) : asked_.contains(name);
  }

  /// How the sentences begin by which the rows of the table refuse this.
  std::vector<std::string> expected() const {
    std::vector<std::string> sentences;
    for (const OptionPair& row : map_option_table().apart)
      if (has(row.option) && has(row.other))
        sentences.push_back(fmt::format("{}: not with {}: ", row.option, row.other));
    for (const OptionPair& row : map_option_table().needed)
      if (has(row.option) && !has(row.other)) sentences.push_back(fmt::format("{}: ", row.option));
    return sentences;
  }

 private:
  void add(const MapOption& option) {
    const Words words = words_of(option);
    const MapJob alone = job_of(words);
    for (const MapOption& other : map_option_table().options)
      if (!is_condition(other) && other.is_asked(alone)) asked_.insert(other.name);
    words_ = words_ + words;
    job_ = job_of(words_);
  }

  void add_if_free(const MapOption& option) {
    if (std::ranges::find(words_, words_of(option)[0]) == words_.end()) add(option);
  }

  Words words_;
  MapJob job_;
  std::set<std::string_view> asked_;
};

/// Expects one line and exit code 2 of the program, and that it writes nothing.
void expect_refused_by_program(const Words& words, const std::string& sentence) {
  const test::TemporaryFolder folder;
  const std::string rows = folder.file("rows.csv", "a,1,2\nb,2,3\nc,3,1\n");
  const std::string out = folder / "map";
  const test::Outcome outcome = test::mapproof(Words{"map", rows, "--out", out} + words);
  EXPECT_EQ(outcome.exit_code, 2) << line_of(words);
  EXPECT_EQ(outcome.error, "mapproof: " + sentence + "\n") << line_of(words);
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_FALSE(std::filesystem::exists(out)) << line_of(words);
}

/// All names of the options that the help lists: those in front of the descriptions.
std::set<std::string> options_in_help(const std::string& help) {
  constexpr std::size_t kDeepest =
      8;  // Columns before an option; descriptions begin further right.
  std::set<std::string> names;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos || begin == 0 || begin > kDeepest || line[begin] != '-')
      continue;
    std::istringstream words(line);
    for (std::string word; words >> word && word[0] == '-';)
      if (word.starts_with("--")) names.insert(word.substr(0, word.find_first_of(",.")));
  }
  return names;
}

TEST(OptionTable, NamesEveryOptionOfTheHelpThatMayConflict) {
  std::set<std::string> known = kFree;
  for (const MapOption& option : map_option_table().options)
    if (!is_condition(option)) known.insert(option.example[0]);
  const std::set<std::string> listed = options_in_help(test::mapproof({"map", "--help"}).out);
  for (const std::string& name : listed)
    EXPECT_TRUE(known.contains(name)) << name << " is neither in the table nor free";
  for (const std::string& name : known)
    EXPECT_TRUE(listed.contains(name)) << name << " is not in the help";
}

TEST(OptionTable, TheHelpOfIncrementalNamesTheOptionsThatItRefusesAndNoOther) {
  Parser parser;
  const std::string help = parser.app.get_option("--incremental")->get_description();
  std::string refused = help.substr(help.find("Not with ") + 9);
  refused.replace(refused.find(" or "), 4, ", ");
  std::string expected;
  for (const OptionPair& row : map_option_table().apart)
    if (row.other == "--incremental")
      expected += (expected.empty() ? "" : ", ") + std::string(row.option);
  EXPECT_EQ(refused, expected);
}

TEST(OptionTable, AcceptsBearingsInDegreesOfTheSecondSensor) {
  EXPECT_EQ(said_of(job_of(
                {"--sensor", "range", "--with", "b.csv", "--with-sensor", "bearing", "--degrees"})),
            "");
}

TEST(OptionTable, HoldsNoOptionTwiceAndNoUnknownOption) {
  std::set<std::string_view> names;
  for (const MapOption& option : map_option_table().options)
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
  for (const auto& rows : {map_option_table().apart, map_option_table().needed}) {
    std::set<std::set<std::string_view>> seen;
    for (const OptionPair& row : rows) {
      EXPECT_TRUE(names.contains(row.option)) << row.option;
      EXPECT_TRUE(names.contains(row.other)) << row.other;
      EXPECT_NE(row.option, row.other);
      EXPECT_TRUE(seen.insert({row.option, row.other}).second) << row.option << " " << row.other;
      EXPECT_FALSE(row.why.empty()) << row.option << " " << row.other;
    }
  }
}

TEST(OptionTable, NoticesEachOptionAndOnlyThatOne) {
  const MapJob none = job_of({});
  EXPECT_EQ(said_of(none), "");
  for (const MapOption& option : map_option_table().options) {
    if (is_condition(option)) continue;
    EXPECT_FALSE(option.is_asked(none)) << option.name;
    const Words words = words_of(option);
    const MapJob job = job_of(words);
    EXPECT_TRUE(option.is_asked(job)) << option.name;
    for (const MapOption& other : map_option_table().options)
      if (!is_condition(other) && other.example[0] != words[0]) {
        EXPECT_FALSE(other.is_asked(job)) << option.name << " asks for " << other.name;
      }
  }
  for (const auto& [name, words] : kFulfilling)
    if (name !=
        "a --with-sensor for each") {  // It counts the files of --with, of which none is here.
      EXPECT_TRUE(option_named(name).is_asked(job_of(words))) << name;
    }
}

TEST(OptionTable, RefusesWhatDoesNotGoTogetherInItsOwnSentence) {
  for (const OptionPair& row : map_option_table().apart) {
    const Words words = words_of(option_named(row.option)) + words_of(option_named(row.other));
    const std::string sentence = said_of(job_of(words));
    const std::string begin = fmt::format("{}: not with {}: ", row.option, row.other);
    EXPECT_TRUE(sentence.starts_with(begin)) << line_of(words) << ": " << sentence;
    EXPECT_GT(sentence.size(), begin.size());
    EXPECT_EQ(sentence.find_first_of("{}\n"), std::string::npos) << sentence;
    expect_refused_by_program(words, sentence);
  }
}

TEST(OptionTable, RefusesWhatLacksItsNeedAndTakesItWithIt) {
  for (const OptionPair& row : map_option_table().needed) {
    const auto failing = kFailing.find(row.other);
    const Words alone = words_of(option_named(row.option)) +
                        (failing == kFailing.end() ? Words{} : failing->second);
    const std::string sentence = said_of(job_of(alone));
    EXPECT_TRUE(sentence.starts_with(fmt::format("{}: ", row.option)))
        << line_of(alone) << ": " << sentence;
    EXPECT_EQ(sentence.find_first_of("{}\n"), std::string::npos) << sentence;
    // A need of the method names the method and its parameter.
    const std::string other = option_word(row.other);
    EXPECT_NE(sentence.find(other.empty() ? "method" : other), std::string::npos) << sentence;
    // The program takes --method pairs for --sensor range-bearing.
    if (row.option != "--method pairs") expect_refused_by_program(alone, sentence);
    Words both = words_of(option_named(row.option)) + words_of(option_named(row.other));
    for (const OptionPair& next : map_option_table().needed) {  // What the other one needs in turn.
      if (next.option != row.other) continue;
      const Words needed = words_of(option_named(next.other));
      if (std::ranges::find(both, needed[0]) == both.end()) both = both + needed;
    }
    EXPECT_EQ(said_of(job_of(both)), "") << line_of(both);
  }
}

TEST(OptionTable, RefusesNoOtherPair) {
  int accepted = 0;
  int refused = 0;
  const auto options = map_option_table().options;
  for (auto first = options.begin(); first != options.end(); ++first)
    for (auto second = std::next(first); second != options.end(); ++second) {
      if (is_condition(*first) || is_condition(*second)) continue;
      const Words one = words_of(*first), two = words_of(*second);
      if (are_alternatives(one, two)) {
        EXPECT_THROW(job_of(one + two), CLI::ParseError) << line_of(one + two);
        continue;
      }
      const Combination pair(*first, *second);
      const std::string sentence = said_of(pair.job());
      const std::vector<std::string> expected = pair.expected();
      const bool is_expected = std::ranges::any_of(
          expected, [&](const std::string& begin) { return sentence.starts_with(begin); });
      EXPECT_TRUE(expected.empty() ? sentence.empty() : is_expected)
          << line_of(pair.words()) << ": \"" << sentence << "\", expected one of "
          << ::testing::PrintToString(expected);
      ++(sentence.empty() ? accepted : refused);
    }
  EXPECT_GT(accepted, 300);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace mapproof
