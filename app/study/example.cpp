#include "app/commands.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/resource.hpp"
#include "core/base/text/spelling.hpp"
#include "core/base/text/words.hpp"
#include "core/records/studies/folder_lock.hpp"

namespace mapproof {

/// The files of examples/: "hall/bearings.csv".
std::span<const Resource> embedded_examples();

namespace {

namespace fs = std::filesystem;

struct ExampleArguments {
  std::string target;
  std::string out = ".";
};

/// An example's name, and a command that uses it in the folder that holds it.
const std::map<std::string, std::string>& uses() {
  static const std::map<std::string, std::string> commands = {
      {"hall",
       "mapproof map hall/bearings.csv --sensor bearing --anchors hall/anchors.csv --ground-truth "
       "hall/ground_truth.csv --out out/hall"},
      {"drive", "mapproof slam drive --out out/drive"},
      {"study", "mapproof run study/experiment.json --out out/study"},
      {"plots", "mapproof diff plots/old plots/new --page out/plots.html"}};
  return commands;
}

std::string folder_of(const Resource& resource) {
  return fs::path(resource.name).begin()->string();
}

/// Refuses to replace a file that is not the example's.
void write_new(const OutputFolder& folder, const Resource& resource) {
  const fs::path path = folder.path() / resource.name;
  const std::optional<std::string> there = folder.read(resource.name);
  if (there && *there != resource.bytes)
    throw IoError(path.string(), "is there and differs from the example; choose another folder");
  folder.write(resource.name, resource.bytes);
}

/// Refuses what is probably a misspelt name, and an --out that would be ignored.
void refuse_slip(const ExampleArguments& arguments) {
  std::vector<std::string_view> names;
  for (const auto& [name, command] : uses()) names.push_back(name);
  const std::string word = lower_case(arguments.target);
  const std::string_view meant = likely_word(word, names);
  if (!meant.empty() && word.find('/') == std::string::npos)
    throw InvalidInput(fmt::format(
        "there is no example \"{}\"; did you mean \"{}\"? For a folder of that name with all "
        "examples write ./{}",
        printable(arguments.target), meant, printable(arguments.target)));
  if (arguments.out != ExampleArguments().out)
    throw InvalidInput(fmt::format(
        "--out is the folder for one example: {}. \"{}\" is none of them, but the folder for all",
        fmt::join(names, ", "), printable(arguments.target)));
}

/// An example by its name into a folder, or all of them.
int write_examples(const ExampleArguments& arguments, const Invocation& invocation) {
  const bool is_name = uses().contains(arguments.target);
  if (!is_name) refuse_slip(arguments);
  const fs::path out = is_name ? fs::path(arguments.out) : fs::path(arguments.target);
  nlohmann::ordered_json object{{"folder", out.string()},
                                {"files", nlohmann::ordered_json::array()},
                                {"commands", nlohmann::ordered_json::array()}};
  const LockedFolder folder(out);
  for (const Resource& resource : embedded_examples()) {
    if (is_name && folder_of(resource) != arguments.target) continue;
    write_new(folder.files(), resource);
    object["files"].push_back((out / resource.name).string());
  }
  std::string text;
  if (out != ".") text += fmt::format("cd {}\n", printable(out.string(), 300));
  for (const auto& [name, command] : uses()) {
    if (is_name && name != arguments.target) continue;
    object["commands"].push_back(command);
    text += command + "\n";
  }
  invocation.console.info(fmt::format(
      "{} of {} written to {}; to use them:", counted(std::ssize(object["files"]), "file"),
      is_name ? "the example " + arguments.target : "all examples", printable(out.string(), 300)));
  invocation.console.result(text, object);
  return kDone;
}

}  // namespace

Action example_command(CLI::App& app) {
  auto arguments = std::make_shared<ExampleArguments>();
  app.description("Write example data, and the commands that use them");
  app.footer(
      "Examples:\n"
      "  mapproof example hall && mapproof map hall/detections.csv --out out/hall\n"
      "  mapproof example examples\n\n"
      "hall: bearings, ranges, range and bearing, and detections of landmarks in a hall, with\n"
      "anchors and ground truth. drive: ranges and odometry. study: an experiment. plots: two\n"
      "folders of plots to compare.\n");
  app.add_option("NAME", arguments->target,
                 "hall, drive, study or plots: that example, into --out. Any other word: a folder "
                 "for all of them")
      ->required();
  add_out_option(app, arguments->out, "Folder for the example of that name")->capture_default_str();
  return
      [arguments](const Invocation& invocation) { return write_examples(*arguments, invocation); };
}

}  // namespace mapproof
