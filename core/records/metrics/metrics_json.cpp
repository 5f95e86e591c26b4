#include "core/records/metrics/metrics_json.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/words.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/json/record_reader.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestName = 200, kLongestUnit = 100;
constexpr double kLargest = 1e100;
constexpr std::string_view kDataPrefix = "window.BENCHMARK_DATA";

/// Which way the tools of github-action-benchmark improve (its src/write/biggerIsBetter.ts).
constexpr std::array kTools = {std::pair("customSmallerIsBetter", Better::kLower),
                               std::pair("customBiggerIsBetter", Better::kHigher),
                               std::pair("cargo", Better::kLower),
                               std::pair("go", Better::kLower),
                               std::pair("benchmarkjs", Better::kHigher),
                               std::pair("benchmarkluau", Better::kLower),
                               std::pair("pytest", Better::kHigher),
                               std::pair("googlecpp", Better::kLower),
                               std::pair("catch2", Better::kLower),
                               std::pair("julia", Better::kLower),
                               std::pair("jmh", Better::kLower),
                               std::pair("benchmarkdotnet", Better::kLower)};

/// A text that pages show as it stands.
std::string shown_text(const JsonCursor& json, std::size_t longest) {
  const std::string text = json.text();
  if (printable(text, longest) != text)
    json.fail(fmt::format("\"{}\" holds hidden characters or more than {}", printable(text, 40),
                          counted(static_cast<long long>(longest), "character")));
  return text;
}

std::string name_text(const JsonCursor& json) {
  const std::string text = shown_text(json, kLongestName);
  if (text.empty()) json.fail("is empty");
  return text;
}

double value_of(const JsonCursor& json) { return json.number_or_null(-kLargest, kLargest); }

/// A commit's id, or nothing of a text that is none.
std::string commit_in(const JsonCursor& json) {
  constexpr std::size_t kShortest = 7, kLongest = 64;
  const std::string text = json.text();
  const bool is_one = text.size() >= kShortest && text.size() <= kLongest &&
                      text.find_first_not_of("0123456789abcdef") == std::string::npos;
  return is_one ? text : "";
}

/// Reads metrics one by one, and knows where each stands.
class MetricList {
 public:
  explicit MetricList(std::vector<Metric>& metrics) : metrics_(metrics) {}

  /// @throws IoError at a metric that is there twice.
  void add(Metric metric, const JsonCursor& at) {
    const auto [known, is_new] =
        places_.try_emplace({metric.suite, metric.name, quantity_of(metric).id}, at.pointer());
    if (!is_new)
      at.fail(fmt::format("the metric \"{}\" is there twice: at {} before",
                          printable(metric.name, 40), known->second));
    if (metrics_.size() == kMostMetrics)
      at.fail(fmt::format("there are more than {} metrics", kMostMetrics));
    metrics_.push_back(std::move(metric));
  }

 private:
  std::vector<Metric>& metrics_;
  std::map<std::tuple<std::string, std::string, std::string>, std::string> places_;
};

/// {name, unit, value} of github-action-benchmark; what it holds besides is not read.
Metric custom_metric(const JsonCursor& json, const std::string& suite,
                     std::optional<Better> better) {
  Metric metric{.name = name_text(json.at("name")),
                .suite = suite,
                .unit = shown_text(json.at("unit"), kLongestUnit),
                .value = value_of(json.at("value"))};
  if (const auto own = json.find("better")) {
    const auto named = better_named(own->text());
    if (!named) own->fail("expected lower, higher or neither");
    better = named;
  }
  if (!better)
    json.fail("does not say which way it improves; --better lower or --better higher does");
  metric.better = *better;
  return metric;
}

void read_list(const JsonCursor& json, std::optional<Better> better, Metrics& all) {
  MetricList list(all.metrics);
  for (const JsonCursor& item : json.elements(1)) list.add(custom_metric(item, "", better), item);
}

Better better_of_tool(const JsonCursor& tool) {
  const std::string name = tool.text();
  for (const auto& [known, better] : kTools)
    if (name == known) return better;
  tool.fail(fmt::format("\"{}\" is not a tool of github-action-benchmark that is known here",
                        printable(name, 40)));
}

void read_data_file(const JsonCursor& json, Metrics& all) {
  MetricList list(all.metrics);
  if (const auto repository = json.find("repoUrl")) all.repository = repository->text();
  const auto entries = json.at("entries").members();
  for (const auto& [suite, runs] : entries) {
    if (printable(suite, kLongestName) != suite)
      runs.fail("its name holds hidden characters or is too long");
    const std::size_t count = runs.elements(1).size();
    const JsonCursor last = runs.element(count - 1);
    const Better better = better_of_tool(last.at("tool"));
    if (const auto commit = last.find("commit"))
      if (const auto id = commit->find("id")) all.commit = commit_in(*id);
    for (const JsonCursor& bench : last.at("benches").elements())
      list.add(custom_metric(bench, entries.size() > 1 ? suite : "", better), bench);
  }
  if (all.metrics.empty()) json.at("entries").fail("holds no metric");
}

/// The repetitions of a benchmark.
struct Repetitions {
  JsonCursor first;
  std::string unit;
  std::vector<double> values;
};

void read_google_benchmark(const JsonCursor& json, Metrics& all) {
  std::vector<std::string> order;
  std::map<std::string, Repetitions> by_name;
  for (const JsonCursor& item : json.at("benchmarks").elements(1)) {
    const auto type = item.find("run_type");
    if (type && type->text() == "aggregate") continue;
    const std::string name = name_text(item.at("name"));
    const auto failed = item.find("error_occurred");
    const bool is_lost = failed && failed->kind() == JsonKind::kBoolean && failed->boolean();
    const auto unit = item.find("time_unit");
    auto [place, is_new] =
        by_name.try_emplace(name, Repetitions{item, unit ? shown_text(*unit, kLongestUnit) : "ns", {}});
    if (is_new) order.push_back(name);
    if (!is_lost) place->second.values.push_back(value_of(item.at("real_time")));
  }
  if (order.empty()) json.at("benchmarks").fail("holds aggregates alone");
  MetricList list(all.metrics);
  for (const std::string& name : order) {
    const Repetitions& of_name = by_name.at(name);
    std::vector<double> known;
    for (const double value : of_name.values)
      if (value == value) known.push_back(value);
    list.add({.name = name,
              .unit = of_name.unit,
              .value = known.empty() ? kNaN : median(known),
              .better = Better::kLower},
             of_name.first);
  }
}

void read_pytest_benchmark(const JsonCursor& json, Metrics& all) {
  if (const auto commit = json.find("commit_info"); commit && commit->is_object())
    if (const auto id = commit->find("id"); id && id->kind() == JsonKind::kString)
      all.commit = commit_in(*id);
  MetricList list(all.metrics);
  for (const JsonCursor& item : json.at("benchmarks").elements(1)) {
    const auto full = item.find("fullname");
    list.add({.name = name_text(full ? *full : item.at("name")),
              .unit = "s",
              .value = value_of(item.at("stats").at("median")),
              .better = Better::kLower},
             item);
  }
}

void read_own(const JsonCursor& json, Metrics& all) {
  all = from_json_value<Metrics>(json);
  Metrics checked{.name = all.name, .commit = all.commit};
  if (!all.name.empty() && slug_of(all.name) != all.name)
    json.at("name").fail("is not lower-case letters, digits and '-'");
  if (!all.commit.empty() && commit_in(json.at("commit")).empty())
    json.at("commit").fail("is not 7 to 64 hexadecimal digits");
  MetricList list(checked.metrics);
  auto metric = all.metrics.begin();
  for (const JsonCursor& item : json.at("metrics").elements()) {
    name_text(item.at("name"));
    if (const auto suite = item.find("suite")) shown_text(*suite, kLongestName);
    if (const auto unit = item.find("unit")) shown_text(*unit, kLongestUnit);
    list.add(std::move(*metric++), item);
  }
  all = std::move(checked);
}

/// A data.js of github-action-benchmark assigns its JSON to a variable: blanks keep lines and
/// columns.
std::string without_assignment(std::string_view text) {
  const std::size_t brace = text.find('{');
  std::string json(text);
  std::ranges::fill(json.begin(), json.begin() + static_cast<long>(brace), ' ');
  const std::size_t last = json.find_last_not_of(" \t\r\n");
  if (json[last] == ';') json[last] = ' ';
  return json;
}

}  // namespace

Quantity quantity_of(const Metric& metric) {
  constexpr std::size_t kDigits = 6;
  std::string slug = slug_of(metric.unit);
  std::ranges::replace(slug, '-', '_');
  std::string of_slug = slug;
  std::ranges::replace(of_slug, '_', '/');
  std::string id = "value";
  if (metric.unit == "%")
    id += "_percent";
  else if (!metric.unit.empty())
    id += slug.empty() ? "" : "_" + slug;
  // Two units that differ in letters' case or in signs have two ids.
  if (!metric.unit.empty() && metric.unit != "%" && of_slug != metric.unit)
    id += "_" + sha256_hex(metric.unit).substr(0, kDigits);
  if (metric.better != Better::kLower) id += fmt::format("_{}", name(metric.better));
  return study_quantity(id, "value", metric.unit, metric.better);
}

Metrics parse_metrics(std::string_view text, const std::string& source,
                      std::optional<Better> better) {
  std::string json_of_script;
  if (trimmed(text, kWhiteSpace).starts_with(kDataPrefix) &&
      text.find('{') != std::string_view::npos)
    text = json_of_script = without_assignment(text);
  const JsonDocument document = parse_json(text, source);
  const JsonCursor json = document.cursor();
  Metrics all;
  if (json.is_array())
    read_list(json, better, all);
  else if (json.is_object() && json.find("schema"))
    read_own(json, all);
  else if (json.is_object() && json.find("entries"))
    read_data_file(json, all);
  else if (json.is_object() && json.find("benchmarks") && json.find("machine_info"))
    read_pytest_benchmark(json, all);
  else if (json.is_object() && json.find("benchmarks"))
    read_google_benchmark(json, all);
  else
    throw IoError(source,
                  "is none of the formats of metrics: mapproof.metrics, github-action-benchmark, "
                  "Google Benchmark, pytest-benchmark");
  return all;
}

}  // namespace mapproof
