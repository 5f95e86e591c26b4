#include "tests/support/program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/support/environment.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

/// In the child: becomes a program, its output going to the two descriptors.
[[noreturn]] void become(const std::vector<std::string>& command, const Limits& limits, int out,
                         int error) {
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(error, STDERR_FILENO);
  for (const auto& [what, bytes] :
       {std::pair(RLIMIT_FSIZE, limits.file_bytes), std::pair(RLIMIT_AS, limits.address_bytes)})
    if (const rlimit limit{bytes, bytes}; bytes > 0) ::setrlimit(what, &limit);
  // A map in space takes a second, and memory; the tests that look at it name the program.
  const auto maps = [](const std::string& word) {
    return word == "map" || word.find(" map ") != std::string::npos;
  };
  if (std::ranges::any_of(command, maps)) ::setenv("MAPPROOF_SCENES", "/nowhere", 0);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

std::vector<std::string> with_program(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), program());
  return arguments;
}

}  // namespace

std::string program() { return MAPPROOF_PROGRAM; }

Outcome mapproof(const std::vector<std::string>& arguments, const Limits& limits) {
  return run_program(with_program(arguments), limits);
}

Outcome run_program(const std::vector<std::string>& command, const Limits& limits) {
  if (limits.address_bytes > 0) skip_if_sanitized();
  std::array<int, 2> out{};
  std::array<int, 2> error{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(error.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) become(command, limits, out[1], error[1]);
  ::close(out[1]);
  ::close(error[1]);

  Outcome outcome;
  std::array<pollfd, 2> streams{pollfd{out[0], POLLIN, 0}, pollfd{error[0], POLLIN, 0}};
  std::array<std::string*, 2> texts{&outcome.out, &outcome.error};
  for (int open = 2; open > 0;) {
    ::poll(streams.data(), streams.size(), -1);
    for (std::size_t i = 0; i < 2; ++i) {
      if (streams[i].fd < 0 || streams[i].revents == 0) continue;
      std::array<char, 4096> block{};
      const ssize_t count = ::read(streams[i].fd, block.data(), block.size());
      if (count > 0) {
        texts[i]->append(block.data(), static_cast<std::size_t>(count));
      } else {
        ::close(streams[i].fd);
        streams[i].fd = -1;
        --open;
      }
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

pid_t start_mapproof(const std::vector<std::string>& arguments) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int nowhere = ::open("/dev/null", O_WRONLY);
  become(with_program(arguments), {}, nowhere, nowhere);
}

std::vector<std::pair<std::string, std::string>> contents(const fs::path& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files.emplace_back(fs::relative(entry.path(), folder).string(), read_file(entry.path()));
  std::ranges::sort(files);
  return files;
}

void expect_same(const Contents& first, const Contents& second) {
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].first, second[i].first);
    EXPECT_TRUE(first[i].second == second[i].second) << first[i].first << " differs";
  }
}

}  // namespace mapproof::test
