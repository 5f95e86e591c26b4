#include "app/commands.hpp"

#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "app/help/generated.hpp"
#include "core/base/files/files.hpp"
#include "core/model/method.hpp"
#include "core/results/quantity.hpp"

namespace mapproof {
namespace {

struct GenerateArguments {
  std::string what;
  std::string out;
};

/// A table of Markdown; no cell holds a bar.
std::string methods_markdown() {
  std::string page =
      "# Methods\n\nAs `mapproof methods` lists them. Their formulas are in [their "
      "pages](methods/README.md).\n\n| name | method | what it does | parameter | source "
      "|\n|---|---|---|---|---|\n";
  for (const MethodInfo& method : all_methods()) {
    const std::string parameter =
        method.parameter ? fmt::format("{}: {}, {:g} to {:g}", method.parameter->shown,
                                       method.parameter->meaning, method.parameter->minimum,
                                       method.parameter->maximum)
                         : "none";
    page += fmt::format("| `{}` | {} | {} | {} | {} |\n", method.name, method.label, method.summary,
                        parameter, method.source);
  }
  return page;
}

std::string quantities_markdown() {
  std::string page =
      "# Quantities\n\nWhat mapproof measures, under the id that it has in files, tables and "
      "`--json`. [file-formats.md](file-formats.md#quantities) explains them.\n\n"
      "| id | quantity | unit | better |\n|---|---|---|---|\n";
  for (const Quantity& quantity : all_quantities())
    page += fmt::format("| `{}` | {} | {} | {} |\n", quantity.id, quantity.label, quantity.unit,
                        name(quantity.better));
  return page;
}

int generate(const GenerateArguments& arguments, const CLI::App& program,
             const Invocation& invocation) {
  const ProgramFacts facts = program_facts(program);
  std::map<std::string, std::string> files;
  if (arguments.what == "completions") files = completion_files(facts);
  if (arguments.what == "man") files = manual_pages(facts);
  if (arguments.what == "docs") 
    files = {{"commands.md", commands_markdown(facts)},
             {"methods-list.md", methods_markdown()},
             {"quantities.md", quantities_markdown()}};
  for (const auto& [path, text] : files)
    write_file(std::filesystem::path(arguments.out) / path, text);
  invocation.console.result("", {{"files", files.size()}, {"folder", arguments.out}});
  return kDone;
}

}  // namespace

Action generate_command(CLI::App& app) {
  auto arguments = std::make_shared<GenerateArguments>();
  app.description("Write completions, manual pages or the page of commands");
  app.footer("Example:\n  mapproof generate completions --out share\n");
  app.group("");  // Help does not list it: the build calls it.
  app.add_option("WHAT", arguments->what, "What is written")
      ->required()
      ->transform(one_of({"completions", "man", "docs"}));
  add_out_option(app, arguments->out, "Folder that they are written into")->required();
  return [arguments, &app](const Invocation& invocation) {
    return generate(*arguments, *app.get_parent(), invocation);
  };
}

}  // namespace mapproof
