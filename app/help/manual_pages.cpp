#include <fmt/format.h>

#include "app/help/generated.hpp"
#include "core/base/version.hpp"

namespace mapproof {
namespace {

/// A text for roff: backslashes and hyphens as they are meant, no line that begins as a request.
std::string roff(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || text[i - 1] == '\n';
    if (begins && (text[i] == '.' || text[i] == '\'')) out += "\\&";
    if (text[i] == '\\')
      out += "\\\\";
    else if (text[i] == '-')
      out += "\\-";
    else
      out += text[i];
  }
  return out;
}

std::string title(const std::string& name) {
  return fmt::format(".TH {} 1 \"\" \"mapproof {}\" \"User Commands\"\n", name, version());
}

std::string manual_page(const CommandFacts& command) {
  const std::string name = "mapproof-" + command.name;
  std::string page = title(name) + ".SH NAME\n" + roff(name) + " \\- " + roff(command.description) +
                     "\n.SH SYNOPSIS\n.B " + roff(usage_of(command)) + "\n";
  for (const std::string& group : groups_of(command)) {
    page += ".SH \"" + roff(group) + "\"\n";
    for (const OptionFacts& option : command.options)
      if (option.group == group)
        page += ".TP\n.B " + roff(spelled(option)) + "\n" + roff(explained(option)) + "\n";
  }
  return page + ".SH \"EXAMPLES AND NOTES\"\n.nf\n" + roff(command.footer) +
         ".fi\n.SH \"SEE ALSO\"\nmapproof(1)\n";
}

/// A text in a cell of a table of Markdown.
std::string in_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

}  // namespace

std::map<std::string, std::string> manual_pages(const ProgramFacts& program) {
  std::map<std::string, std::string> pages;
  std::string all = title("mapproof") + ".SH NAME\nmapproof \\- " +
                    roff(program.program.description) +
                    "\n.SH SYNOPSIS\n.B mapproof COMMAND [OPTIONS]\n.SH COMMANDS\n";
  for (const CommandFacts& command : program.commands) {
    pages["man/man1/mapproof-" + command.name + ".1"] = manual_page(command);
    all += ".TP\n.B " + command.name + "\n" + roff(command.description) + ". See mapproof\\-" +
           command.name + "(1).\n";
  }
  pages["man/man1/mapproof.1"] = all + ".SH NOTES\n.nf\n" + roff(program.program.footer) + ".fi\n";
  return pages;
}

std::string commands_markdown(const ProgramFacts& program) {
  std::string page = "# Commands\n\n" + program.program.description + ".\n\n";
  for (const CommandFacts& command : program.commands)
    page += fmt::format("- [`{0}`](#{0}): {1}\n", command.name, command.description);
  for (const CommandFacts& command : program.commands) {
    page += fmt::format("\n## {}\n\n{}.\n\n    {}\n", command.name, command.description,
                        usage_of(command));
    for (const std::string& group : groups_of(command)) {
      page += "\n**" + group + "**\n\n| option | meaning |\n|---|---|\n";
      for (const OptionFacts& option : command.options) {
        if (option.group != group) continue;
        page +=
            fmt::format("| `{}` | {} |\n", in_cell(spelled(option)), in_cell(explained(option)));
      }
    }
    page += "\n```\n" + command.footer + "```\n";
  }
  return page;
}

}  // namespace mapproof
