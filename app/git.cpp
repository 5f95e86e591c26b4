#include "app/git.hpp"

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

namespace mapproof {

bool GitAnswer::is_missing() const {
  constexpr int kNotFound = 127;  // Of env.
  return end.exit_code == kNotFound;
}

GitAnswer git(const std::vector<std::string>& words, std::string_view input) {
  ProgramCall call{.program = "/usr/bin/env",
                   .arguments = {"LC_ALL=C", "GIT_TERMINAL_PROMPT=0", "git", "--no-pager"}};
  call.arguments.insert(call.arguments.end(), words.begin(), words.end());
  const Descriptor in = memory_file("mapproof-git");
  if (!write_all(in, input)) throw ProcessError(fmt::format("git: {}", std::strerror(errno)));
  return {answer_of(call, in)};
}

}  // namespace mapproof
