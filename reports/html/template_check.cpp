#include "reports/html/template_check.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

constexpr int kDeepest = 50;  ///< Sections within sections.
constexpr int kMostIncludes = 1000;
constexpr std::size_t kLargestPage = std::size_t{16} << 20;

struct Tag {
  char kind;  ///< '#', '^', '/', '>', '=', '!' or another.
  std::string name;
  std::size_t line;
  std::size_t begin;  ///< Of the whole tag, braces and all.
  std::size_t end;
};

std::string line_text(std::size_t line) { return fmt::format("line {}", line); }

std::vector<Tag> tags(const std::string& source, const std::string& text) {
  std::vector<Tag> found;
  std::size_t line = 1;
  std::size_t counted = 0;  // Line breaks before here are in `line`.
  for (std::size_t at = text.find("{{"); at != std::string::npos; at = text.find("{{", at)) {
    for (; counted < at; ++counted) line += text[counted] == '\n' ? 1 : 0;
    const std::size_t end = text.find("}}", at);
    if (end == std::string::npos) throw IoError(source, line_text(line), "the tag is not closed");
    const std::string_view content =
        trimmed(std::string_view(text).substr(at + 2, end - at - 2), kWhiteSpace);
    const char kind = content.empty() ? ' ' : content[0];
    const std::string_view name = content.substr(content.empty() ? 0 : 1);
    found.push_back({kind, std::string(trimmed(name, kWhiteSpace)), line, at, end + 2});
    at = end + 2;
  }
  return found;
}

void check_sections(const std::string& source, const std::vector<Tag>& tags) {
  std::vector<const Tag*> open;
  for (const Tag& tag : tags) {
    if (tag.kind == '=')
      throw IoError(source, line_text(tag.line), "templates keep the delimiters {{ and }}");
    if (tag.kind == '#' || tag.kind == '^') open.push_back(&tag);
    if (open.size() > kDeepest)
      throw IoError(source, line_text(tag.line),
                    fmt::format("more than {} sections deep", kDeepest));
    if (tag.kind != '/') continue;
    if (open.empty() || open.back()->name != tag.name)
      throw IoError(
          source, line_text(tag.line),
          "the section \"" + printable(tag.name) + "\" ends here but is not the open one");
    open.pop_back();
  }
  if (!open.empty())
    throw IoError(source, line_text(open.back()->line),
                  "the section \"" + printable(open.back()->name) + "\" is not closed");
}

void refuse(const std::string& source, const std::string& text, std::string_view what) {
  const std::size_t at = lower_case(text).find(what);
  if (at == std::string::npos) return;
  const auto line = static_cast<std::size_t>(
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  throw IoError(source, line_text(line),
                fmt::format("\"{}\" would end its element in the page", what));
}

/// Puts a template together with those that it includes.
class Assembler {
 public:
  Assembler(const std::map<std::string, std::string>& files,
            const std::map<std::string, std::string>& sources)
      : files_(files), sources_(sources) {}

  void add(const std::string& name) {
    const std::string& text = files_.at(name);
    const std::string& source = sources_.at(name);
    open_.push_back(name);
    std::size_t done = 0;
    for (const Tag& tag : tags(source, text)) {
      if (tag.kind != '>') continue;
      const std::string included = tag.name + ".mustache";
      if (!files_.contains(included))
        throw IoError(source, line_text(tag.line),
                      "there is no template \"" + printable(tag.name) + "\" to include");
      if (std::ranges::find(open_, included) != open_.end())
        throw IoError(source, line_text(tag.line),
                      "\"" + tag.name + "\" would include itself without end");
      page_.append(text, done, tag.begin - done);
      if (++count_ > kMostIncludes || page_.size() > kLargestPage)
        throw IoError(source, "the templates include one another too often");
      add(included);
      done = tag.end;
    }
    page_.append(text, done);
    open_.pop_back();
  }

  std::string page() { return std::move(page_); }

 private:
  const std::map<std::string, std::string>& files_;
  const std::map<std::string, std::string>& sources_;
  std::vector<std::string> open_;  ///< Templates that include one another, the outer one first.
  int count_ = 0;
  std::string page_;
};

}  // namespace

void check_templates(const std::map<std::string, std::string>& files,
                     const std::map<std::string, std::string>& sources) {
  for (const auto& [name, text] : files) {
    const std::string& source = sources.at(name);
    if (name.ends_with(".css")) refuse(source, text, "</style");
    if (name.ends_with(".js")) {
      refuse(source, text, "</script");
      refuse(source, text, "<!--");
    }
    if (!name.ends_with(".mustache")) continue;
    check_sections(source, tags(source, text));
    const kainjow::mustache::mustache parsed(text);
    if (!parsed.is_valid()) throw IoError(source, parsed.error_message());
  }
  for (const auto& [name, text] : files)
    if (name.ends_with(".mustache")) assembled(name, files, sources);
}

std::string assembled(const std::string& name, const std::map<std::string, std::string>& files,
                      const std::map<std::string, std::string>& sources) {
  Assembler assembler(files, sources);
  assembler.add(name);
  return assembler.page();
}

}  // namespace mapproof
