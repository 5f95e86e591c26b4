#include "app/help/command_facts.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mapproof {
namespace {

constexpr const char* kOther = "Other";  ///< What has no group of its own.

/// What stands between the braces of "TEXT:{a,b}".
std::vector<std::string> choices_of(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return choices;
  for (std::size_t at = open + 1; at <= close;) {
    const std::size_t end = std::min(type.find(',', at), close);
    choices.push_back(type.substr(at, end - at));
    at = end + 1;
  }
  return choices;
}

/// The kind of value in capitals: what the option was given, or by its type.
std::string value_of(const std::string& type) {
  std::string first = type.substr(0, type.find(':'));
  for (const char* kind : {"DIR", "FILE"})
    if (type.find(kind) != std::string::npos) return kind;
  if (first == "INT" || first == "UINT") return "N";
  if (first == "FLOAT") return "NUMBER";
  if (first == "TEXT" || first.empty()) return "TEXT";
  return first;
}

/// "from 2 to 20" of "FLOAT in [2 - 20]".
std::string bounds_of(const std::string& type) {
  const std::size_t open = type.find(" in ["), close = type.find(']');
  if (open == std::string::npos || close == std::string::npos) return "";
  const std::string inside = type.substr(open + 5, close - open - 5);
  const std::size_t between = inside.find(" - ");
  if (between == std::string::npos) return "";
  return fmt::format("from {} to {}", inside.substr(0, between), inside.substr(between + 3));
}

std::string group_of(const CLI::Option& option) {
  const std::string& group = option.get_group();
  return group == "Options" ? kOther : group;
}

OptionFacts option_facts(const CLI::Option& option) {
  OptionFacts facts;
  facts.is_argument = option.get_positional() && !option.nonpositional();
  if (facts.is_argument) {
    facts.names = {option.get_name(true, false)};
  } else {
    for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
  }
  facts.description = option.get_description();
  facts.is_required = option.get_required();
  facts.group = facts.is_argument && option.get_group() == "Options" ? "Input" : group_of(option);
  facts.takes_several = option.get_expected_max() > 1;
  if (option.get_items_expected_max() == 0) return facts;  // A flag.
  const std::string type = option.get_type_name();
  facts.choices = choices_of(type);
  facts.value = value_of(type);
  facts.default_value = option.get_default_str();
  if (const std::string bounds = bounds_of(type); !bounds.empty())
    facts.description += ", " + bounds;
  return facts;
}

/// Its first long name, else its only one: later long names are aliases.
const std::string& long_name(const OptionFacts& option) {
  const auto found = std::ranges::find_if(
      option.names, [](const std::string& name) { return name.starts_with("--"); });
  return found == option.names.end() ? option.names.front() : *found;
}

}  // namespace

CommandFacts facts_of(const CLI::App& command) {
  CommandFacts facts{.name = command.get_name(),
                     .description = command.get_description(),
                     .footer = command.get_footer(),
                     .options = {}};
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty()) facts.options.push_back(option_facts(*option));
  return facts;
}

ProgramFacts program_facts(const CLI::App& program) {
  ProgramFacts facts{.program = facts_of(program), .commands = {}};
  for (const CLI::App* sub : program.get_subcommands({}))
    if (!sub->get_group().empty()) facts.commands.push_back(facts_of(*sub));
  return facts;
}

std::vector<std::string> groups_of(const CommandFacts& command) {
  std::vector<std::string> groups;
  for (const OptionFacts& option : command.options)
    if (option.group != kOther && std::ranges::find(groups, option.group) == groups.end())
      groups.push_back(option.group);
  // What is read comes first, what is written last.
  const auto rank = [](const std::string& group) {
    return group == "Input" ? 0 : group == "Output" ? 2 : 1;
  };
  std::ranges::stable_sort(groups, {}, rank);
  groups.emplace_back(kOther);
  return groups;
}

std::string usage_of(const CommandFacts& command) {
  std::string usage = "mapproof " + command.name + " [OPTIONS]";
  for (const OptionFacts& option : command.options) {
    if (!option.is_argument && !option.is_required) continue;
    const std::string one = option.is_argument
                                ? option.names.front() + (option.takes_several ? "..." : "")
                                : fmt::format("{} {}", long_name(option), option.value);
    usage += option.is_required ? " " + one : " [" + one + "]";
  }
  return usage;
}

std::string spelled(const OptionFacts& option) {
  std::string text = fmt::format("{}", fmt::join(option.names, ", "));
  if (option.is_argument || option.value.empty()) return text;
  constexpr std::size_t kLongest = 32;
  std::string choices = fmt::format("{}", fmt::join(option.choices, "|"));
  const bool shows_choices = !choices.empty() && choices.size() <= kLongest;
  return text + " " + (shows_choices ? choices : option.value);
}

std::string explained(const OptionFacts& option) {
  std::string text = option.description;
  const bool shows_choices = spelled(option).find('|') != std::string::npos;
  const bool says_choices = std::ranges::all_of(option.choices, [&](const std::string& choice) {
    return text.find(choice) != std::string::npos;
  });
  if (!option.choices.empty() && !shows_choices && !says_choices)
    text += fmt::format(". One of {}", fmt::join(option.choices, ", "));
  if (!option.default_value.empty())
    text += fmt::format(". The default is {}", option.default_value);
  return text.ends_with('.') || text.empty() ? text : text + ".";
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

}  // namespace mapproof
