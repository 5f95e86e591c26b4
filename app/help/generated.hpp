#pragma once

#include <map>
#include <string>

#include "app/help/command_facts.hpp"

namespace mapproof {

/// Files that describe the command line, by their paths in a share folder, all made of the same
/// facts: completions of bash, zsh and fish, and a page of the manual for the program and each
/// command.
std::map<std::string, std::string> completion_files(const ProgramFacts& program);
std::map<std::string, std::string> manual_pages(const ProgramFacts& program);

/// One page of Markdown on all commands.
std::string commands_markdown(const ProgramFacts& program);

}  // namespace mapproof
