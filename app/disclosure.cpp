#include "app/disclosure.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <system_error>

#include <pwd.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "core/base/sha256.hpp"
#include "reports/html/block_data.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string machine_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// The number of this installation of the operating system; empty where there is none.
std::string machine_id() {
  std::ifstream file("/etc/machine-id");
  std::string id;
  std::getline(file, id);
  return id;
}

/// A folder in the spellings of paths, JSON, HTML and URLs.
std::set<std::string> spellings(const std::string& folder) {
  const std::string json =
      nlohmann::json(folder).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return {folder, json.substr(1, json.size() - 2), html_escaped(folder), percent_encoded(folder)};
}

/// Every path of the home folder, in every spelling, the longest first.
std::vector<std::string> home_spellings() {
  std::set<std::string> folders = {variable("HOME")}, all;
  if (const passwd* entry = ::getpwuid(::getuid()); entry != nullptr) folders.insert(entry->pw_dir);
  for (const std::string& folder : std::set<std::string>(folders)) {
    std::error_code error;
    folders.insert(fs::canonical(folder, error).string());
  }
  for (std::string folder : folders) {
    while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
    if (folder.size() > 1 && folder.starts_with('/')) all.merge(spellings(folder));
  }
  std::vector<std::string> sorted(all.begin(), all.end());
  std::ranges::stable_sort(sorted, std::ranges::greater(), &std::string::size);
  return sorted;
}

/// Names of the user and the host. "root" names nobody.
std::vector<std::pair<std::string, std::string>> private_names() {
  std::set<std::string> users = {variable("USER"), variable("LOGNAME")};
  if (const passwd* entry = ::getpwuid(::getuid()); entry != nullptr) users.insert(entry->pw_name);
  std::vector<std::pair<std::string, std::string>> names;
  for (const std::string& user : users)
    if (!user.empty() && user != "root") names.emplace_back(user, "USER");
  const std::string host = machine_name();
  if (!host.empty() && host != "localhost") names.emplace_back(host, "HOST");
  return names;
}

/// Whether a path can go on with this character: "/home/a" is not in "/home/ab", nor in "x/home/a".
bool is_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.' ||
         static_cast<unsigned char>(c) >= 0x80;
}

/// A full stop ends a sentence, or begins an extension.
bool is_end_of_name(std::string_view text, std::size_t at) {
  if (at < text.size() && text[at] == '.') ++at;
  return at >= text.size() || !is_of_name(text[at]);
}

/// Whether a host is behind the slash at `at`, as in "http://host": it is not a folder.
bool begins_host(std::string_view text, std::size_t at) {
  return at >= 2 && at < text.size() && text.substr(at - 2).starts_with("://");
}

constexpr std::size_t kLongestPath = 4096;
constexpr std::string_view kEndsOfPath = "\"'<>\n\t";

void replace_folder(std::string& text, const std::string& folder) {
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at)) {
    const std::size_t end = at + folder.size();
    const bool begins = at == 0 || (!is_of_name(text[at - 1]) && !begins_host(text, at));
    if (begins && is_end_of_name(text, end)) text.replace(at, folder.size(), "~");
    ++at;
  }
}

/// Where a path that begins at `at` has come to the folder of these names, by "..", "." and "//"
/// too; npos: nowhere.
std::size_t end_of_folder(std::string_view text, std::size_t at,
                          const std::vector<std::string_view>& names) {
  const std::size_t end = at + std::min(text.substr(at, kLongestPath).find_first_of(kEndsOfPath),
                                        std::min(text.size() - at, kLongestPath));
  std::vector<std::string_view> there;
  while (at < end && text[at] == '/') {
    while (at < end && text[at] == '/') ++at;
    // What follows the last name is any end of a name: a blank, a comma.
    if (there.size() + 1 == names.size() && std::equal(there.begin(), there.end(), names.begin()) &&
        text.substr(at).starts_with(names.back()) && is_end_of_name(text, at + names.back().size()))
      return at + names.back().size();
    const std::size_t slash = text.substr(0, end).find('/', at);
    if (slash == std::string_view::npos) break;
    const std::string_view name = text.substr(at, slash - at);
    if (name == "..") {
      if (!there.empty()) there.pop_back();
    } else if (name != ".") {
      there.push_back(name);
    }
    at = slash;
  }
  return std::string_view::npos;
}

/// The names of the folders of a path.
std::vector<std::string_view> names_of(std::string_view folder) {
  std::vector<std::string_view> names;
  for (std::size_t at = 1; at <= folder.size();) {
    const std::size_t end = std::min(folder.find('/', at), folder.size());
    names.push_back(folder.substr(at, end - at));
    at = end + 1;
  }
  return names;
}

/// The same where the path takes a detour, as "/media/../home/ann". In linear time, since a page
/// holds images as text with many slashes.
void replace_detours(std::string& text, const std::string& folder) {
  const std::vector<std::string_view> names = names_of(folder);
  const std::string last = "/" + std::string(names.back());
  std::size_t tried = 0;  // No path that begins before it is open.
  std::size_t next = 0;   // Of the last name, behind which no path ends before.
  for (std::size_t at = 0; (at = text.find('/', at)) != std::string::npos; ++at) {
    const std::string_view rest = std::string_view(text).substr(at);
    if (!rest.starts_with("/../") && !rest.starts_with("/./") && !rest.starts_with("//")) continue;
    std::size_t begin = std::max(tried, at > kLongestPath ? at - kLongestPath : 0);
    const std::string_view before = std::string_view(text).substr(begin, at - begin);
    if (const std::size_t end = before.find_last_of(kEndsOfPath); end != before.npos) begin += end;
    for (; (begin = text.find('/', begin)) <= at; ++begin) {
      if (next < begin) next = text.find(last, begin);
      if (next == std::string::npos) return;
      if (next - begin > kLongestPath) continue;
      if (begin > 0 && (is_of_name(text[begin - 1]) || text[begin - 1] == '/')) continue;
      if (begins_host(text, begin + 1)) continue;
      const std::size_t end = end_of_folder(text, begin, names);
      if (end == std::string::npos || end <= at) continue;
      text.replace(begin, end - begin, "~");
      at = begin;
      next = 0;
      break;
    }
    tried = at + 1;
  }
}

/// Whether the word looks like "name@host.domain", and not like the image "ID@KEY.png".
bool is_address(std::string_view word) {
  constexpr std::array<std::string_view, 9> kFiles = {"png", "svg", "pdf", "json", "csv",
                                                      "tum", "txt", "gz",  "xz"};
  const std::size_t at = word.find('@'), dot = word.rfind('.');
  if (at == 0 || at == word.npos || dot == word.npos || dot < at + 2) return false;
  const std::string_view domain = word.substr(dot + 1);
  return domain.size() >= 2 && std::ranges::find(kFiles, domain) == kFiles.end() &&
         std::ranges::all_of(
             domain, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; });
}

/// What ends a path in a word that holds more than a path, and can stand before one.
constexpr std::string_view kBesidePaths = " \t\n'\"=:,;@()<>|&";

/// Whether an absolute path begins there, as in "/a", "--out=/a", "-o/a", "make -C /a" and
/// "file:///a", but not in "http://a".
bool begins_path(std::string_view word, std::size_t at) {
  if (at == 0 || word.substr(0, at).ends_with("://")) return true;
  if (begins_host(word, at + 1)) return false;
  return kBesidePaths.find(word[at - 1]) != std::string_view::npos ||
         (at == 2 && word.front() == '-' && word[1] != '-');
}

/// Where the path that begins there ends: one that is the whole value of an argument, or quoted,
/// may have blanks.
std::size_t end_of_path(std::string_view word, std::size_t begin) {
  if (begin == 0 || (word.starts_with("--") && word.find('=') + 1 == begin)) return word.size();
  const char before = word[begin - 1];
  const std::size_t end = before == '\'' || before == '"' ? word.find(before, begin)
                                                          : word.find_first_of(kBesidePaths, begin);
  return std::min(end, word.size());
}

/// An absolute path as one from this folder, if it is in it: "data/a.csv"; the last name of any
/// other: "…/a.csv".
std::string shortened_path(const std::string& path, const fs::path& here) {
  const fs::path there = fs::path(path).lexically_normal();
  if (std::distance(here.begin(), here.end()) > 1) {
    const std::string inside = there.lexically_relative(here).string();
    if (!inside.starts_with("..")) return inside.starts_with('-') ? "./" + inside : inside;
  }
  const fs::path name = there.has_filename() ? there.filename() : there.parent_path().filename();
  return name.empty() ? path : kUnshownFolder + name.string();
}

void shorten_paths(std::string& word, const fs::path& here) {
  for (std::size_t at = 0; (at = word.find('/', at)) != std::string::npos;) {
    if (!begins_path(word, at)) {
      ++at;
      continue;
    }
    const std::size_t size = end_of_path(word, at) - at;
    const std::string shown = shortened_path(word.substr(at, size), here);
    word.replace(at, size, shown);
    at += shown.size();
  }
}

}  // namespace

Disclosure::Disclosure(bool full) : full_(full) {
  if (full_) return;
  homes_ = home_spellings();
  names_ = private_names();
}

std::string Disclosure::text(std::string text) const {
  for (const std::string& home : homes_) replace_folder(text, home);
  for (const std::string& home : homes_) replace_detours(text, home);
  return text;
}

std::string Disclosure::word(std::string word, const fs::path& here) const {
  word = text(std::move(word));
  shorten_paths(word, here);
  std::string kept;
  for (std::size_t at = 0; at <= word.size();) {
    const std::size_t end = std::min(word.find_first_of("/=:,", at), word.size());
    const std::string part = word.substr(at, end - at);
    const auto name = std::ranges::find(names_, part, &std::pair<std::string, std::string>::first);
    kept += name != names_.end() ? name->second : is_address(part) ? "E-MAIL" : part;
    if (end < word.size()) kept += word[end];
    at = end + 1;
  }
  return kept;
}

std::vector<std::string> Disclosure::words(std::vector<std::string> words) const {
  if (full_) return words;
  std::error_code error;
  const fs::path here = fs::current_path(error);
  for (std::string& one : words) one = word(std::move(one), here);
  return words;
}

std::vector<std::string> Disclosure::method_command(std::vector<std::string> words) const {
  if (full_) return words;
  for (std::string& one : words) one = word(std::move(one), {});
  return words;
}

std::string Disclosure::host() const {
  if (full_) return machine_name();
  constexpr std::size_t kDigits = 8;
  return "host-" +
         sha256_hex("mapproof\n" + machine_id() + '\n' + machine_name()).substr(0, kDigits);
}

}  // namespace mapproof
