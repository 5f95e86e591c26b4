#include "app/console.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "app/help/help_text.hpp"
#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr int kResultVersion =
    1;  ///< Raised when a key is renamed, removed or means another thing.

/// One line of a message, however hostile the names in it.
std::string one_line(const std::string& message) { return printable(message, 4000); }

constexpr std::string_view kWipe = "\r\033[K";

/// The state of the one terminal that the program writes to.
std::mutex terminal_mutex;                   // NOLINT: there is one terminal.
std::atomic<bool> terminal_has_line{false};  // NOLINT: likewise.

/// What the handler of a signal writes: nothing in it may allocate.
std::array<char, 200> last_words{};       // NOLINT: a handler gets no other argument.
std::atomic<std::size_t> last_length{0};  // NOLINT: likewise.

extern "C" void end_with_a_word(int signal) {
  if (terminal_has_line.load()) (void)!::write(STDERR_FILENO, kWipe.data(), kWipe.size());
  (void)!::write(STDERR_FILENO, last_words.data(), last_length.load());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Text that is not UTF-8 is corrected.
std::string dumped(const nlohmann::ordered_json& value) {
  return value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

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

std::string Console::json_text(const nlohmann::ordered_json& object) const {
  nlohmann::ordered_json whole_object;
  whole_object["schema"] = {{"name", "mapproof.result." + command_}, {"version", kResultVersion}};
  if (!object.is_null()) whole_object.update(object);
  return dumped(whole_object) + "\n";
}

void Console::result(const std::string& text, const nlohmann::ordered_json& object) const {
  print(json_ ? json_text(object) : text);
}

void Console::list(const std::string& key, std::size_t count,
                   const std::function<nlohmann::ordered_json(std::size_t)>& item) const {
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  const std::string whole = json_text({{key, nlohmann::ordered_json::array()}});
  const std::size_t end = whole.rfind(']');
  std::string text = whole.substr(0, end);
  for (std::size_t i = 0; i < count; ++i) {
    text += i == 0 ? "\n    " : ",\n    ";
    for (const char c : dumped(item(i))) {
      text += c;
      if (c == '\n') text += "    ";
    }
    if (text.size() < kBlock) continue;
    print(text);
    text.clear();
  }
  print(text + (count == 0 ? "" : "\n  ") + whole.substr(end));
}

void Console::print(const std::string& text) const {
  wipe_progress_line();
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (std::fflush(stdout) != 0 || !whole) throw IoError("standard output", "cannot be written");
}

void wipe_progress_line() {
  const std::lock_guard lock(terminal_mutex);
  if (!terminal_has_line.exchange(false)) return;
  std::fwrite(kWipe.data(), 1, kWipe.size(), stderr);
  std::fflush(stderr);
}

ProgressLine::ProgressLine(const Console& console, std::string doing)
    : shown_(!console.is_quiet()),
      terminal_(::isatty(STDERR_FILENO) == 1),
      text_(std::move(doing)) {
  if (shown_ && terminal_) redrawing_ = std::thread([this] { redraw(); });
}

ProgressLine::~ProgressLine() {
  if (redrawing_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    ends_.notify_all();
    redrawing_.join();
  }
  if (shown_) wipe_progress_line();
}

/// What takes long shows that it goes on.
void ProgressLine::redraw() {
  constexpr auto kPause = std::chrono::milliseconds(500);
  std::unique_lock lock(mutex_);
  while (!ends_.wait_for(lock, kPause, [this] { return ended_; })) {
    const std::lock_guard terminal(terminal_mutex);
    if (terminal_has_line && Clock::now() - last_ < 2 * kPause) continue;
    last_ = Clock::now();
    std::fputs(fmt::format("{}{}, {:.0f} s", kWipe, text_, seconds()).c_str(), stderr);
    std::fflush(stderr);
    terminal_has_line = true;
  }
}

double ProgressLine::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void ProgressLine::operator()(const Progress& progress) {
  show(progress_text(progress, seconds()));
}

void ProgressLine::show(const std::string& text) {
  if (!shown_) return;
  const std::lock_guard lock(terminal_mutex);
  const Clock::time_point now = Clock::now();
  const auto pause = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000);
  text_ = text;
  if (now - last_ < pause) return;
  last_ = now;
  std::fputs((terminal_ ? std::string(kWipe) + text : text + "\n").c_str(), stderr);
  std::fflush(stderr);
  terminal_has_line = terminal_;
}

std::function<void(const std::string&)> note_to(const Console& console) {
  return [&console](const std::string& text) { console.info(text); };
}

CountProgress count_progress(const Console& console, std::string doing) {
  auto line = std::make_shared<ProgressLine>(console, doing);
  return [line, doing = std::move(doing)](std::size_t done, std::size_t total) {
    line->show(fmt::format("{} {} of {}", doing, done, total));
  };
}

std::string progress_text(const Progress& progress, double seconds) {
  std::string text = fmt::format("{} of {} {}", progress.finished, progress.total, progress.noun);
  const int made = progress.finished - progress.reused;
  if (made < 1 || seconds <= 0.0) return text;
  const double rate = made / seconds;
  return text + fmt::format(", {:.3g} {}/s, {:.0f} s left", rate, progress.noun,
                            (progress.total - progress.finished) / rate);
}

void say_when_stopped(std::string_view last_word) {
  const std::string text = "mapproof: " + std::string(last_word) + "\n";
  const std::size_t length = std::min(text.size(), last_words.size());
  std::copy_n(text.begin(), length, last_words.begin());
  last_length = length;
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    std::signal(signal, end_with_a_word);
  }
}

}  // namespace mapproof
