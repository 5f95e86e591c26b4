#pragma once

#include <chrono>
#include <string>

#include "core/topics/study_plan.hpp"

namespace mapproof {

/// Shows how far an experiment has come on standard error: one line that is redrawn on a terminal,
/// a plain line every five seconds elsewhere.
class ProgressLine {
 public:
  explicit ProgressLine(bool shown);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void operator()(const Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// "12 of 25 runs, 3.1 runs/s, 4 s left", after that many seconds.
std::string progress_text(const Progress& progress, double seconds);

}  // namespace mapproof
