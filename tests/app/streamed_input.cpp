#include "tests/app/streamed_input.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

namespace mapproof::test {
namespace {

/// Writes the bytes into a pipe once somebody reads it, for as long as somebody does.
void feed(const std::string& pipe, const std::string& bytes, const std::atomic<bool>& ended) {
  int file = -1;
  while (!ended && (file = ::open(pipe.c_str(), O_WRONLY | O_NONBLOCK)) < 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (file < 0) return;
  ::fcntl(file, F_SETFL, 0);  // From here on it waits for the reader.
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t written = ::write(file, bytes.data() + at, bytes.size() - at);
    if (written <= 0) break;
    at += static_cast<std::size_t>(written);
  }
  ::close(file);
}

}  // namespace

Outcome followed(const std::string& command, const TemporaryFolder& folder,
                 const std::string& bytes, const std::vector<std::string>& more) {
  const std::string pipe = folder / "pipe";
  EXPECT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::signal(SIGPIPE, SIG_IGN);  // A program that ends early fails its test, not all of them.
  std::atomic<bool> ended = false;
  std::thread writer([&] { feed(pipe, bytes, ended); });
  std::vector<std::string> all = {command, pipe, "--incremental", "--json"};
  all.insert(all.end(), more.begin(), more.end());
  const Outcome outcome = mapproof(all);
  ended = true;
  writer.join();
  ::unlink(pipe.c_str());
  return outcome;
}

}  // namespace mapproof::test
