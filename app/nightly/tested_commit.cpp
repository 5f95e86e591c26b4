#include "app/nightly/tested_commit.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "app/git.hpp"
#include "core/base/errors.hpp"
#include "core/base/text/percent.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kNone = "none";
constexpr std::string_view kHttps = "https://";

bool is_commit(std::string_view text) {
  constexpr std::size_t kShortest = 7, kLongest = 64;
  return text.size() >= kShortest && text.size() <= kLongest &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Whether it is a plain address: http or https, a host without a user, and nothing that a page or a
/// shell could take for more.
bool is_plain_address(std::string_view text) {
  constexpr std::size_t kLongest = 500;
  const std::string_view scheme = text.starts_with("http://") ? "http://" : kHttps;
  if (!text.starts_with(scheme) || text.size() == scheme.size() || text.size() > kLongest)
    return false;
  return std::ranges::all_of(text.substr(scheme.size()),
                             [](char c) { return is_plain(c, "-._~/:%+"); }) &&
         text[scheme.size()] != '/';
}

std::string line_of_git(const std::vector<std::string>& words) {
  try {
    const GitAnswer answer = git(words);
    return answer.end.is_success() ? answer.line() : "";
  } catch (const ProcessError&) {
    return "";
  }
}

std::string without_end(std::string text, std::string_view end) {
  while (text.ends_with(end)) text.erase(text.size() - end.size());
  return text;
}

std::string asked_repository(const std::string& text) {
  std::string address = without_end(text, "/");
  if (text == kNone) return "";
  if (!is_plain_address(address))
    throw InvalidInput(fmt::format(
        "--repository-url: \"{}\" is not a plain address, as https://github.com/me/project",
        printable(text)));
  return address;
}

}  // namespace

std::string page_of_remote(const std::string& remote) {
  std::string rest = remote;
  const std::size_t scheme = rest.find("://");
  if (scheme != std::string::npos) {
    const std::string name = rest.substr(0, scheme);
    if (name != "https" && name != "http" && name != "ssh" && name != "git") return "";
    rest.erase(0, scheme + 3);
  }
  // Who is asked to log in is nobody's business.
  const std::size_t slash = rest.find('/');
  if (const std::size_t at = rest.rfind('@', slash); at != std::string::npos) rest.erase(0, at + 1);
  if (scheme == std::string::npos) {  // host:owner/name, as scp has it.
    const std::size_t colon = rest.find(':');
    if (colon == std::string::npos || colon > rest.find('/')) return "";
    rest[colon] = '/';
  }
  const std::string page = std::string(kHttps) + without_end(without_end(rest, "/"), ".git");
  return is_plain_address(page) ? page : "";
}

TestedCommit tested_commit(const CommitOptions& options, const TestedCommit& otherwise) {
  TestedCommit tested;
  if (options.repository) tested.repository = asked_repository(*options.repository);
  if (options.commit && *options.commit != kNone) {
    if (!is_commit(*options.commit))
      throw InvalidInput(fmt::format(
          "--commit: \"{}\" is not a commit's id of 7 to 64 hexadecimal digits, and not none",
          printable(*options.commit)));
    tested.id = *options.commit;
  }
  const std::string head =
      options.commit ? tested.id : line_of_git({"rev-parse", "--verify", "--quiet", "HEAD"});
  const bool is_here = is_commit(head);
  if (!options.commit) tested.id = is_here ? head : is_commit(otherwise.id) ? otherwise.id : "";
  if (!options.repository && !tested.id.empty())
    tested.repository = is_here ? page_of_remote(line_of_git({"remote", "get-url", "origin"}))
                                : otherwise.repository;
  return tested;
}

}  // namespace mapproof
