#include "app/progress_line.hpp"

#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

namespace mapproof {

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

}  // namespace mapproof
