#include "app/command_line.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>
#include <thread>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

std::string quoted(const std::string& word) {
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

void add_seed_option(CLI::App& app, std::optional<std::uint64_t>& seed) {
  const auto read = [&seed](const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      throw CLI::ValidationError(
          "--seed", "\"" + printable(text) + "\" is no whole number from 0 to 2^64 - 1");
    seed = value;
  };
  app.add_option_function<std::string>("--seed", read, "Replaces the experiment's seed");
}

CLI::Option* add_out_option(CLI::App& app, std::string& out, const std::string& what) {
  const auto has_name = [](const std::string& text) {
    return text.empty() ? std::string("an empty name is no folder") : std::string();
  };
  return app.add_option("--out", out, what)->check(CLI::Validator(has_name, ""));
}

}  // namespace mapproof
