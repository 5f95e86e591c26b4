#include "app/console.hpp"

#include <cstdio>
#include <utility>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "app/help/help_text.hpp"
#include "app/progress_line.hpp"
#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr int kResultVersion =
    1;  ///< Raised when a key is renamed, removed or means another thing.

/// One line of a message, however hostile the names in it.
std::string one_line(const std::string& message) { return printable(message, 4000); }

}  // namespace

Console::Console(Verbosity verbosity, bool json, std::string command)
    : verbosity_(verbosity), json_(json), command_(std::move(command)) {
  auto logger = std::make_shared<spdlog::logger>("mapproof",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%v");
  logger->set_level(verbosity == Verbosity::kQuiet     ? spdlog::level::warn
                    : verbosity == Verbosity::kVerbose ? spdlog::level::debug
                                                       : spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void Console::info(const std::string& message) const {
  wipe_progress_line();
  spdlog::info("{}", one_line(message));
}

void Console::detail(const std::string& message) const {
  wipe_progress_line();
  spdlog::debug("{}", one_line(message));
}

void Console::warning(const std::string& message) const {
  wipe_progress_line();
  const bool coloured = shows_colours(STDERR_FILENO);
  spdlog::warn("{}warning:{} {}", coloured ? "\033[33m" : "", coloured ? "\033[0m" : "",
               one_line(message));
}

void Console::result(const std::string& text, const nlohmann::ordered_json& object) const {
  nlohmann::ordered_json whole_object;
  whole_object["schema"] = {{"name", "mapproof.result." + command_}, {"version", kResultVersion}};
  if (!object.is_null()) whole_object.update(object);
  const std::string out =
      json_ ? whole_object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
            : text;
  print(out);
}

void Console::print(const std::string& text) const {
  wipe_progress_line();
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (std::fflush(stdout) != 0 || !whole) throw IoError("standard output", "cannot be written");
}

}  // namespace mapproof
