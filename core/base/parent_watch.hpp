#pragma once

#include <chrono>
#include <cstdlib>
#include <thread>

#include <unistd.h>

namespace mapproof {

/// Ends this program within a tenth of a second of the end of the one that started it, however that
/// ends. A signal by the kernel (PR_SET_PDEATHSIG) would come at the end of the thread that started
/// it, which may be one of many.
inline void end_with_parent() {
  std::thread([parent = ::getppid()] {
    while (::getppid() == parent) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ::_exit(EXIT_FAILURE);
  }).detach();
}

}  // namespace mapproof
