#include "app/help/help_text.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/base/text/utf8.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLeast = 50, kMost = 100;  // Columns of help.
constexpr std::size_t kIndent = 6;               // Of what an option does, below its name.

std::string heading(const std::string& text, const HelpStyle& style) {
  return style.colours ? "\033[1m" + text + "\033[0m\n" : text + "\n";
}

std::size_t columns_in(std::string_view text) {
  std::size_t count = 0;
  for (; !text.empty(); ++count) take_code_point(text);
  return count;
}

/// Lines of a footer: examples as they stand, sentences wrapped.
std::string footer_text(const std::string& footer, std::size_t width) {
  std::string out, paragraph;
  const auto end_paragraph = [&] {
    if (!paragraph.empty()) out += wrapped(paragraph, width, 0);
    paragraph.clear();
  };
  for (std::size_t at = 0; at < footer.size();) {
    const std::size_t end = std::min(footer.find('\n', at), footer.size());
    const std::string line = footer.substr(at, end - at);
    at = end + 1;
    const bool stands = line.empty() || line.front() == ' ' || line.back() == ':';
    if (!stands) {
      paragraph += (paragraph.empty() ? "" : " ") + line;
      continue;
    }
    end_paragraph();
    const bool is_command = line.find("mapproof ") != std::string::npos;
    const bool is_wrapped = line.size() > width && line.starts_with("  ") && !is_command;
    // An item of a list goes on two columns further in.
    out += is_wrapped ? wrapped(line.substr(line.find_first_not_of(' ')), width, 4).substr(2)
                      : line + "\n";
  }
  end_paragraph();
  return out;
}

class Formatter : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    const HelpStyle style = terminal_style();
    return app->get_parent() == nullptr ? help_text(program_facts(*app), style)
                                        : help_text(facts_of(*app), style);
  }
};

}  // namespace

bool shows_colours(int stream) {
  const char* none = std::getenv("NO_COLOR");
  const char* kind = std::getenv("TERM");
  return ::isatty(stream) == 1 && (none == nullptr || *none == '\0') && kind != nullptr &&
         std::string_view(kind) != "dumb";
}

HelpStyle terminal_style() {
  HelpStyle style{.width = 80, .colours = shows_colours(STDOUT_FILENO)};
  winsize size{};
  if (const char* columns = std::getenv("COLUMNS"); columns != nullptr && std::atoi(columns) > 0)
    style.width = static_cast<std::size_t>(std::atoi(columns));
  else if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    style.width = size.ws_col;
  style.width = std::clamp(style.width, kLeast, kMost);
  return style;
}

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
  std::string out, line;
  const std::string margin(indent, ' ');
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    at = end + 1;
    if (word.empty()) continue;
    if (!line.empty() && indent + columns_in(line) + 1 + columns_in(word) > width) {
      out += margin + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? out : out + margin + line + "\n";
}

std::string help_text(const CommandFacts& command, const HelpStyle& style) {
  std::string out = wrapped(command.description + ".", style.width, 0);
  out += "\n" + heading("Usage", style) + wrapped(usage_of(command), style.width, 2);
  for (const std::string& group : groups_of(command)) {
    out += "\n" + heading(group, style);
    for (const OptionFacts& option : command.options) {
      if (option.group != group) continue;
      out += wrapped(spelled(option) + (option.is_required ? " (required)" : ""), style.width, 2);
      out += wrapped(explained(option), style.width, kIndent);
    }
  }
  return out + "\n" + footer_text(command.footer, style.width);
}

std::string help_text(const ProgramFacts& program, const HelpStyle& style) {
  std::string out = wrapped(program.program.description + ".", style.width, 0);
  out += "\n" + heading("Usage", style) + "  mapproof COMMAND [OPTIONS]\n";
  out += "\n" + heading("Commands", style);
  for (const CommandFacts& command : program.commands) {
    constexpr std::size_t kColumn = 14;
    std::string lines = wrapped(command.description, style.width, kColumn);
    lines.replace(2, command.name.size(), command.name);
    out += lines;
  }
  out += "\n" + heading("Options", style);
  for (const OptionFacts& option : program.program.options) {
    out += "  " + spelled(option) + "\n";
    out += wrapped(explained(option), style.width, kIndent);
  }
  return out + "\n" + footer_text(program.program.footer, style.width);
}

std::shared_ptr<CLI::FormatterBase> help_formatter() { return std::make_shared<Formatter>(); }

}  // namespace mapproof
