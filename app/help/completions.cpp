#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/help/generated.hpp"

namespace mapproof {
namespace {

/// The first sentence of a description, harmless between single quotes of any shell.
std::string short_words(const std::string& description) {
  std::string words = description.substr(0, description.find(". "));
  std::erase_if(words, [](char c) { return c == '\'' || c == '"' || c == '[' || c == ']' ||
                                           c == ':' || c == '\\' || c == '`' || c == '$'; });
  return words;
}

std::vector<std::string> all_names(const CommandFacts& command) {
  std::vector<std::string> names;
  for (const OptionFacts& option : command.options)
    if (!option.is_argument) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::string command_names(const ProgramFacts& program) {
  std::vector<std::string> names;
  for (const CommandFacts& command : program.commands) names.push_back(command.name);
  return fmt::format("{}", fmt::join(names, " "));
}

/// Cases of an option's value: "map:--sensor) words=...".
std::string bash_values(const CommandFacts& command) {
  std::string cases;
  for (const OptionFacts& option : command.options) {
    if (option.is_argument || option.value.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names) patterns.push_back(command.name + ":" + name);
    std::string what = "return 0";
    if (!option.choices.empty())
      what = fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$word\")); return 0",
                         fmt::join(option.choices, " "));
    else if (option.value == "DIR")
      what = "COMPREPLY=($(compgen -d -- \"$word\")); return 0";
    else if (option.value == "FILE")
      what = "COMPREPLY=($(compgen -f -- \"$word\")); return 0";
    cases += fmt::format("    {}) {} ;;\n", fmt::join(patterns, "|"), what);
  }
  return cases;
}

std::string bash_completion(const ProgramFacts& program) {
  std::string values, options;
  for (const CommandFacts& command : program.commands) {
    values += bash_values(command);
    options += fmt::format("    {}) words='{}' ;;\n", command.name,
                           fmt::join(all_names(command), " "));
  }
  return fmt::format(
      "# Completion of mapproof for bash; made by \"mapproof generate\".\n"
      "_mapproof() {{\n"
      "  local word=\"${{COMP_WORDS[COMP_CWORD]}}\" before=\"${{COMP_WORDS[COMP_CWORD-1]}}\"\n"
      "  local command=\"${{COMP_WORDS[1]}}\" words=''\n"
      "  COMPREPLY=()\n"
      "  if [[ $COMP_CWORD -eq 1 || ( $command == help && $COMP_CWORD -eq 2 ) ]]; then\n"
      "    COMPREPLY=($(compgen -W '{} help --help --version' -- \"$word\"))\n"
      "    return 0\n"
      "  fi\n"
      "  case \"$command:$before\" in\n{}  esac\n"
      "  case \"$command\" in\n{}  esac\n"
      "  if [[ $word == -* ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
      "  else\n"
      "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
      "  fi\n"
      "}}\n"
      "complete -o filenames -F _mapproof mapproof\n",
      command_names(program), values, options);
}

std::string zsh_option(const OptionFacts& option) {
  std::string text;
  for (const std::string& name : option.names) {
    std::string value;
    if (!option.value.empty()) {
      std::string what = option.value == "DIR"    ? "_files -/"
                         : option.value == "FILE" ? "_files"
                                                  : " ";
      if (!option.choices.empty()) what = fmt::format("({})", fmt::join(option.choices, " "));
      value = fmt::format(":{}:{}", option.value, what);
    }
    text += fmt::format("        '{}{}[{}]{}' \\\n", option.takes_several ? "*" : "", name,
                        short_words(option.description), value);
  }
  return text;
}

std::string zsh_completion(const ProgramFacts& program) {
  std::string commands, cases;
  for (const CommandFacts& command : program.commands) {
    commands += fmt::format("    '{}:{}'\n", command.name, short_words(command.description));
    cases += fmt::format("    {})\n      _arguments \\\n", command.name);
    for (const OptionFacts& option : command.options)
      if (!option.is_argument) cases += zsh_option(option);
    cases += "        '*:file:_files'\n      ;;\n";
  }
  return fmt::format(
      "#compdef mapproof\n"
      "# Completion of mapproof for zsh; made by \"mapproof generate\".\n"
      "_mapproof() {{\n"
      "  local -a commands\n"
      "  commands=(\n{}    'help:Show the help of a command'\n  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe 'command' commands\n"
      "    return\n"
      "  fi\n"
      "  local command=\"${{words[2]}}\"\n"
      "  words=(\"${{words[@]:1}}\")\n"
      "  (( CURRENT-- ))\n"
      "  case \"$command\" in\n{}    help)\n      _describe 'command' commands\n      ;;\n  esac\n"
      "}}\n"
      "_mapproof \"$@\"\n",
      commands, cases);
}

std::string fish_completion(const ProgramFacts& program) {
  std::string out =
      "# Completion of mapproof for fish; made by \"mapproof generate\".\n"
      "complete -c mapproof -n __fish_use_subcommand -f -a help -d 'Show the help of a command'\n";
  for (const CommandFacts& command : program.commands) {
    out += fmt::format("complete -c mapproof -n __fish_use_subcommand -f -a {} -d '{}'\n",
                       command.name, short_words(command.description));
    for (const OptionFacts& option : command.options) {
      if (option.is_argument) continue;
      out += fmt::format("complete -c mapproof -n '__fish_seen_subcommand_from {}'", command.name);
      for (const std::string& name : option.names)
        out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.value.empty()) out += option.choices.empty() ? " -r" : " -x";
      if (!option.choices.empty()) out += fmt::format(" -a '{}'", fmt::join(option.choices, " "));
      out += fmt::format(" -d '{}'\n", short_words(option.description));
    }
  }
  return out;
}

}  // namespace

std::map<std::string, std::string> completion_files(const ProgramFacts& program) {
  return {{"bash-completion/completions/mapproof", bash_completion(program)},
          {"zsh/site-functions/_mapproof", zsh_completion(program)},
          {"fish/vendor_completions.d/mapproof.fish", fish_completion(program)}};
}

}  // namespace mapproof
