#include "reports/html/template_check.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr int kDeepest = 50;  ///< Sections within sections.
constexpr int kMostIncludes = 1000;
constexpr std::size_t kLargestPage = std::size_t{16} << 20;
constexpr std::string_view kBlank = " \t\r\n";

struct Tag {
  char kind;  ///< '#', '^', '/', '>', '=', '!' or another.
  std::string name;
  std::size_t line;
  std::size_t begin;  ///< Of the whole tag, braces and all.
  std::size_t end;
};

std::string place(std::size_t line) { return fmt::format("line {}", line); }

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kBlank) - first + 1));
}

std::vector<Tag> tags(const std::string& source, const std::string& text) {
  std::vector<Tag> found;
  std::size_t line = 1;
  std::size_t counted = 0;  // Line breaks before here are in `line`.
  for (std::size_t at = text.find("{{"); at != std::string::npos; at = text.find("{{", at)) {
    for (; counted < at; ++counted) line += text[counted] == '\n' ? 1 : 0;
    const std::size_t end = text.find("}}", at);
    if (end == std::string::npos) throw IoError(source, place(line), "the tag is not closed");
    const std::string content = trimmed(std::string_view(text).substr(at + 2, end - at - 2));
    const char kind = content.empty() ? ' ' : content[0];
    found.push_back({kind, content.empty() ? "" : trimmed(content.substr(1)), line, at, end + 2});
    at = end + 2;
  }
  return found;
}

void check_sections(const std::string& source, const std::vector<Tag>& tags) {
  std::vector<const Tag*> open;
  for (const Tag& tag : tags) {
    if (tag.kind == '=')
      throw IoError(source, place(tag.line), "templates keep the delimiters {{ and }}");
    if (tag.kind == '#' || tag.kind == '^') open.push_back(&tag);
    if (open.size() > kDeepest)
      throw IoError(source, place(tag.line), fmt::format("more than {} sections deep", kDeepest));
    if (tag.kind != '/') continue;
    if (open.empty() || open.back()->name != tag.name)
      throw IoError(
          source, place(tag.line),
          "the section \"" + printable(tag.name) + "\" ends here but is not the open one");
    open.pop_back();
  }
  if (!open.empty())
    throw IoError(source, place(open.back()->line),
                  "the section \"" + printable(open.back()->name) + "\" is not closed");
}

/// Which templates a template includes, and where.
using Includes = std::map<std::string, std::vector<Tag>>;

enum class Visit { kNever, kOpen, kDone };

void check_includes(const std::string& name, const Includes& includes,
                    const std::map<std::string, std::string>& sources,
                    std::map<std::string, Visit>& visits) {
  visits[name] = Visit::kOpen;
  for (const Tag& tag : includes.at(name)) {
    const std::string included = tag.name + ".mustache";
    if (!includes.contains(included))
      throw IoError(sources.at(name), place(tag.line),
                    "there is no template \"" + printable(tag.name) + "\" to include");
    if (visits[included] == Visit::kOpen)
      throw IoError(sources.at(name), place(tag.line),
                    "\"" + tag.name + "\" would include itself without end");
    if (visits[included] == Visit::kNever) check_includes(included, includes, sources, visits);
  }
  visits[name] = Visit::kDone;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

void refuse(const std::string& source, const std::string& text, std::string_view what) {
  const std::size_t at = lower(text).find(what);
  if (at == std::string::npos) return;
  const auto line = static_cast<std::size_t>(
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  throw IoError(source, place(line), fmt::format("\"{}\" would end its element in the page", what));
}

void assemble(const std::string& name, const std::map<std::string, std::string>& files, int& count,
              std::string& out) {
  const std::string& text = files.at(name);
  std::size_t done = 0;
  for (const Tag& tag : tags(name, text)) {
    if (tag.kind != '>') continue;
    out.append(text, done, tag.begin - done);
    if (++count > kMostIncludes || out.size() > kLargestPage)
      throw IoError(name, "the templates include one another too often");
    assemble(tag.name + ".mustache", files, count, out);
    done = tag.end;
  }
  out.append(text, done);
}

}  // namespace

void check_templates(const std::map<std::string, std::string>& files,
                     const std::map<std::string, std::string>& sources) {
  Includes includes;
  for (const auto& [name, text] : files) {
    const std::string& source = sources.at(name);
    if (name.ends_with(".css")) refuse(source, text, "</style");
    if (name.ends_with(".js")) {
      refuse(source, text, "</script");
      refuse(source, text, "<!--");
    }
    if (!name.ends_with(".mustache")) continue;
    const std::vector<Tag> found = tags(source, text);
    check_sections(source, found);
    const kainjow::mustache::mustache parsed(text);
    if (!parsed.is_valid()) throw IoError(source, parsed.error_message());
    auto& included = includes[name];
    std::ranges::copy_if(found, std::back_inserter(included),
                         [](const Tag& tag) { return tag.kind == '>'; });
  }
  std::map<std::string, Visit> visits;
  for (const auto& [name, included] : includes)
    if (visits[name] == Visit::kNever) check_includes(name, includes, sources, visits);
}

std::string assembled(const std::string& name, const std::map<std::string, std::string>& files) {
  std::string out;
  int count = 0;
  assemble(name, files, count, out);
  return out;
}

}  // namespace mapproof
