#include "app/command_line.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <string_view>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/retired_names.hpp"
#include "core/base/text/shell_word.hpp"
#include "core/base/text/spelling.hpp"
#include "core/base/text/words.hpp"
#include "core/records/limits.hpp"

namespace mapproof {
namespace {

/// @param which  "above 0".
CLI::Validator number_that(std::function<bool(double)> holds, const std::string& which,
                           const std::string& name) {
  return {[=](std::string& text) -> std::string {
            double number = 0.0;
            if (CLI::detail::lexical_cast(text, number) && std::isfinite(number) && holds(number))
              return "";
            return fmt::format("\"{}\" is not a number {}", printable(text), which);
          },
          name};
}

}  // namespace

std::string quoted_command(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) command += (command.empty() ? "" : " ") + shell_word(word);
  return command;
}

void group_options(CLI::App& app, const OptionGroups& groups) {
  for (const auto& [group, names] : groups)
    for (const std::string& name : names) app.get_option(name)->group(group);
}

void exclude_one_another(CLI::App& app, const std::vector<std::string>& names) {
  for (auto one = names.begin(); one != names.end(); ++one)
    for (auto other = one + 1; other != names.end(); ++other)
      app.get_option(*one)->excludes(app.get_option(*other));
}

void add_jobs_option(CLI::App& app, int& jobs) {
  jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  app.add_option("-j,--jobs", jobs,
                 "Number of threads, by default one per core; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->group("Output");
}

void add_experiment_options(CLI::App& app, ExperimentChanges& changes) {
  const auto read = [&changes](const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      throw CLI::ValidationError(
          "--seed", "\"" + printable(text) + "\" is not a whole number from 0 to 2^64 - 1");
    changes.seed = value;
  };
  app.add_option_function<std::string>("--seed", read,
                                       "Replaces the experiment's seed: a whole number")
      ->type_name("N")
      ->group("Experiment");
  app.add_option("--layouts", changes.layouts, "Replaces the number of layouts")
      ->check(CLI::Range(1, kMostLayouts))
      ->group("Experiment");
  app.add_option("--poses", changes.poses, "Replaces the number of initial poses in each")
      ->check(CLI::Range(1, kMostPoses))
      ->group("Experiment");
}

CLI::Validator one_of(std::vector<std::string> words) {
  std::string shown = "{" + CLI::detail::join(words, ",") + "}";
  return {[words = std::move(words)](std::string& text) -> std::string {
            const auto same = [&](const std::string& word) {
              return lower_case(word) == lower_case(text);
            };
            const auto found = std::ranges::find_if(words, same);
            if (found != words.end()) {
              text = *found;
              return "";
            }
            const std::vector<std::string_view> known(words.begin(), words.end());
            if (const std::string_view now = replacement_of(NameKind::kValue, text, known);
                !now.empty())
              return fmt::format("{} is now called {}", printable(text), now);
            const std::string_view meant = likely_word(lower_case(text), known);
            return fmt::format("no value \"{}\"{} {}", printable(text),
                               meant.empty()
                                   ? "; there are"
                                   : fmt::format("; did you mean \"{}\"? There are", meant),
                               listed(words, words.size()));
          },
          std::move(shown)};
}

CLI::Validator number_in(double low, double high) {
  return number_that([=](double number) { return number >= low && number <= high; },
                     fmt::format("from {} to {}", low, high),
                     fmt::format("FLOAT in [{} - {}]", low, high));
}

CLI::Validator above_zero() {
  return number_that([](double number) { return number > 0.0; }, "above 0", "POSITIVE");
}

CLI::Validator not_negative() {
  return number_that([](double number) { return number >= 0.0; }, "from 0 on", "NONNEGATIVE");
}

CLI::Validator finite_number() {
  return number_that([](double) { return true; }, "that is finite", "");
}

CLI::Validator names_folder() {
  const auto problem = [](const std::string& text) -> std::string {
    return text == "-" ? "standard input is not a folder" : "";
  };
  return {problem, "DIR"};
}

CLI::Option* add_out_option(CLI::App& app, std::string& out, const std::string& what) {
  return app.add_option("-o,--out", out, what)->check(names_folder())->group("Output");
}

}  // namespace mapproof
