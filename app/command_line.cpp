#include "app/command_line.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/records/limits.hpp"

namespace mapproof {
namespace {

std::string quoted(const std::string& word) {
  if (word.starts_with("~/")) return "~/" + (word.size() > 2 ? quoted(word.substr(2)) : "");
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_./=,:+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string quoted_command(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) command += (command.empty() ? "" : " ") + quoted(word);
  return command;
}

void add_jobs_option(CLI::App& app, int& jobs) {
  jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  app.add_option("--jobs", jobs, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
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
  app.add_option_function<std::string>("--seed", read, "Replaces the experiment's seed");
  app.add_option("--layouts", changes.layouts, "Replaces the number of layouts")
      ->check(CLI::Range(1, kMostLayouts));
  app.add_option("--poses", changes.poses, "Replaces the number of initial poses in each")
      ->check(CLI::Range(1, kMostPoses));
}

CLI::Validator names_folder() {
  const auto problem = [](const std::string& text) -> std::string {
    if (text == "-") return "standard input is not a folder";
    return text.empty() ? "an empty name is not a folder" : "";
  };
  return {problem, ""};
}

CLI::Option* add_out_option(CLI::App& app, std::string& out, const std::string& what) {
  return app.add_option("--out", out, what)->check(names_folder());
}

}  // namespace mapproof
