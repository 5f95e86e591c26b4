#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace mapproof {

/// One option or argument of a command, in plain words.
struct OptionFacts {
  std::vector<std::string> names;    ///< "-o", "--out"; of an argument its name alone: "INPUT".
  std::string value;                 ///< "DIR"; empty: it takes none.
  std::string description;           ///< Sentences, without the default.
  std::string default_value;         ///< Empty: none, or the description has it.
  std::vector<std::string> choices;  ///< All values that it takes, if they are words.
  std::string group;                 ///< "Input".
  bool is_argument = false;
  bool is_required = false;
  bool takes_several = false;
};

/// A command, as help, manual and completions describe it.
struct CommandFacts {
  std::string name;         ///< "map".
  std::string description;  ///< A sentence.
  std::string footer;       ///< Examples and remarks, in lines as they stand.
  std::vector<OptionFacts> options;
};

/// The program: its commands, hidden ones apart, and what all of them share.
struct ProgramFacts {
  CommandFacts program;
  std::vector<CommandFacts> commands;
};

/// What the parser of a command knows of it.
CommandFacts facts_of(const CLI::App& command);
ProgramFacts program_facts(const CLI::App& program);

/// The groups of a command's options, each once, in the order in which help shows them.
std::vector<std::string> groups_of(const CommandFacts& command);

/// "mapproof map [OPTIONS] OBSERVATIONS --out DIR".
std::string usage_of(const CommandFacts& command);

/// "-o, --out DIR", "INPUT".
std::string spelled(const OptionFacts& option);

/// The description with the values and the default behind it.
std::string explained(const OptionFacts& option);

/// All names of options of the command, in order: "--out", "-o".
std::vector<std::string> option_names(const CLI::App& command);

}  // namespace mapproof
