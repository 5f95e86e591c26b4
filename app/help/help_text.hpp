#pragma once

#include <memory>
#include <string>

#include "app/help/command_facts.hpp"

namespace mapproof {

/// How help is set.
struct HelpStyle {
  std::size_t width = 80;  ///< Columns.
  bool colours = false;    ///< Headings are bold.
};

/// That of the terminal that standard output is: its width up to 100 columns, colours unless
/// NO_COLOR is set. Elsewhere 80 columns without colours; COLUMNS replaces them.
HelpStyle terminal_style();

/// Whether a stream (STDOUT_FILENO, STDERR_FILENO) shows colours: a terminal that is not dumb,
/// without NO_COLOR.
bool shows_colours(int stream);

/// `text` in lines of at most `width` columns, each after `indent` spaces, words whole.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent);

/// Help of a command, and of the program.
std::string help_text(const CommandFacts& command, const HelpStyle& style);
std::string help_text(const ProgramFacts& program, const HelpStyle& style);

/// For CLI::App::formatter(): the same, in the style of the terminal.
std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace mapproof
