#include "app/diff/git_baseline.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "app/git.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 100'000;
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 32;
constexpr std::uint64_t kBytesPerCall = std::uint64_t{1} << 26;

[[noreturn]] void refuse(const std::string& text, std::string_view why) {
  throw InvalidInput(fmt::format("--baseline-ref {}: {}", printable(text), why));
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

/// Whether a path has a component that leads out of its folder, or into the repository itself.
bool leads_out(std::string_view path) {
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    std::string part(path.substr(at, end - at));
    std::ranges::transform(part, part.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (part == ".." || part == ".git") return true;
    at = end + 1;
  }
  return false;
}

/// The answer of a call that has to succeed.
GitAnswer required(const GitFolder& source, const std::vector<std::string>& words,
                   std::string_view input = {}) {
  GitAnswer answer = git(words, input);
  if (answer.is_missing()) refuse(source.text(), "git is not installed");
  if (!answer.end.is_success())
    refuse(source.text(), fmt::format("git: {}", printable(last_line(answer.messages), 500)));
  return answer;
}

/// A file of the commit.
struct GitFile {
  std::string object;
  std::uint64_t bytes = 0;
  std::string path;
};

/// Reads "100644 blob HASH    SIZE\tPATH" of git ls-tree; other modes go to `left_out`.
void add_entry(std::string_view entry, std::vector<GitFile>& files,
               std::vector<std::string>& left_out) {
  const std::size_t tab = entry.find('\t');
  if (tab == std::string_view::npos) return;
  const std::string path(entry.substr(tab + 1));
  if (!entry.starts_with("100")) {  // 120000 is a link, 160000 a submodule.
    left_out.push_back(path);
    return;
  }
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < tab;) {
    const std::size_t end = std::min(entry.find(' ', at), tab);
    if (end > at) words.push_back(entry.substr(at, end - at));
    at = end + 1;
  }
  GitFile file{.object = "", .path = path};
  if (words.size() == 4) {
    file.object = words[2];
    std::from_chars(words[3].data(), words[3].data() + words[3].size(), file.bytes);
  }
  files.push_back(std::move(file));
}

std::vector<GitFile> listed_files(const GitFolder& source, const std::string& tree,
                                  std::vector<std::string>& left_out) {
  const GitAnswer answer = required(source, {"ls-tree", "-r", "-l", "-z", "--full-tree", tree});
  std::vector<GitFile> files;
  for (std::size_t at = 0; at < answer.output.size();) {
    const std::size_t end = std::min(answer.output.find('\0', at), answer.output.size());
    add_entry(std::string_view(answer.output).substr(at, end - at), files, left_out);
    at = end + 1;
  }
  std::uint64_t bytes = 0;
  for (const GitFile& file : files) {
    if (file.object.empty() || leads_out(file.path) || file.path.starts_with('/'))
      throw IoError(source.text(),
                    "holds a file that cannot be written safely: " + printable(file.path));
    bytes += file.bytes;
  }
  if (files.size() > kMostFiles || bytes > kMostBytes)
    throw IoError(source.text(), "holds more than 100,000 files or 4 GiB: name a folder below it");
  return files;
}

/// Writes files from one call of git cat-file, whose output is "HASH blob SIZE\nBYTES\n" for each.
void extract(const GitFolder& source, std::span<const GitFile> files, const OutputFolder& folder) {
  std::string objects;
  for (const GitFile& file : files) objects += file.object + "\n";
  const GitAnswer answer = required(source, {"cat-file", "--batch"}, objects);
  std::size_t at = 0;
  for (const GitFile& file : files) {
    const std::string head = fmt::format("{} blob {}\n", file.object, file.bytes);
    if (answer.output.compare(at, head.size(), head) != 0 ||
        answer.output.size() < at + head.size() + file.bytes)
      throw IoError(source.text(), "git does not give " + printable(file.path));
    folder.write(file.path, std::string_view(answer.output).substr(at + head.size(), file.bytes));
    at += head.size() + file.bytes + 1;
  }
}

}  // namespace

GitFolder parse_git_folder(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) refuse(text, "is not REF:PATH, as in origin/main:plots");
  GitFolder source{text.substr(0, colon), text.substr(colon + 1)};
  if (source.ref.empty()) refuse(text, "names no commit before the colon");
  if (std::ranges::any_of(text, is_control)) refuse(text, "holds a control character");
  if (source.ref.find_first_of(" *?[\\") != std::string::npos || source.ref.starts_with('-') ||
      source.ref.starts_with('^') || source.ref.find("..") != std::string::npos ||
      source.ref.find("^{/") != std::string::npos)
    refuse(text, "is not the name of one commit");
  while (source.path.ends_with('/')) source.path.pop_back();
  if (source.path.starts_with('/') || leads_out(source.path))
    refuse(text, "the path leads out of the repository");
  return source;
}

GitBaseline::GitBaseline(const GitFolder& source) {
  const std::string up = required(source, {"rev-parse", "--show-cdup"}).line();
  working_folder_ = source.path.starts_with("./") ? source.path.substr(2) : up + source.path;
  if (working_folder_.empty()) working_folder_ = ".";
  const GitAnswer commit = git({"rev-parse", "--verify", "--quiet", source.ref + "^{commit}"});
  if (!commit.end.is_success())
    refuse(source.text(), fmt::format("git has no commit \"{}\" here. A clone for CI may lack it: "
                                      "\"git fetch origin BRANCH\" gets it",
                                      printable(source.ref)));
  commit_ = commit.line();
  const GitAnswer tree = git({"rev-parse", "--verify", "--quiet", commit_ + ":" + source.path});
  exists_ = tree.end.is_success();
  if (!exists_) return;
  if (required(source, {"cat-file", "-t", tree.line()}).line() != "tree")
    refuse(source.text(), "is a file; name the folder that holds it");
  const std::vector<GitFile> files = listed_files(source, tree.line(), left_out_);
  for (std::size_t first = 0; first < files.size();) {
    std::uint64_t bytes = 0;
    std::size_t last = first;
    while (last < files.size() && (last == first || bytes + files[last].bytes <= kBytesPerCall))
      bytes += files[last++].bytes;
    extract(source, std::span(files).subspan(first, last - first), folder_.path());
    first = last;
  }
}

}  // namespace mapproof
