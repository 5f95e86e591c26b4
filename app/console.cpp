#include "app/console.hpp"

#include <cstdio>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr int kResultVersion =
    1;  ///< Raised when a key is renamed, removed or means another thing.

/// One line of a message, however hostile the names in it.
std::string one_line(const std::string& message) { return printable(message, 4000); }

}  // namespace

ProgressLine::ProgressLine(bool shown) : shown_(shown), terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::operator()(const Progress& progress) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  const auto pause = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000);
  if (now - last_ < pause) return;
  last_ = now;
  const std::string text =
      progress_text(progress, std::chrono::duration<double>(now - start_).count());
  std::fputs((terminal_ ? "\r\033[K" + text : text + "\n").c_str(), stderr);
  std::fflush(stderr);
  drawn_ = terminal_;
}

std::string progress_text(const Progress& progress, double seconds) {
  std::string text = fmt::format("{} of {} {}", progress.finished, progress.total, progress.noun);
  const int made = progress.finished - progress.reused;
  if (made < 1 || seconds <= 0.0) return text;
  const double rate = made / seconds;
  return text + fmt::format(", {:.3g} {}/s, {:.0f} s left", rate, progress.noun,
                            (progress.total - progress.finished) / rate);
}

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

void Console::info(const std::string& message) const { spdlog::info("{}", one_line(message)); }

void Console::detail(const std::string& message) const { spdlog::debug("{}", one_line(message)); }

void Console::warning(const std::string& message) const {
  spdlog::warn("warning: {}", one_line(message));
}

void Console::result(const std::string& text, const nlohmann::ordered_json& object) const {
  nlohmann::ordered_json whole_object;
  whole_object["schema"] = {{"name", "mapproof.result." + command_}, {"version", kResultVersion}};
  if (!object.is_null()) whole_object.update(object);
  const std::string out =
      json_ ? whole_object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
            : text;
  const bool whole = std::fwrite(out.data(), 1, out.size(), stdout) == out.size();
  if (std::fflush(stdout) != 0 || !whole) throw IoError("standard output", "cannot be written");
}

}  // namespace mapproof
