// Runs targets on files without libFuzzer, with any compiler.
//   TARGET FILE...   the target on its seeds and on each file, or on the files of a folder
//   --all CORPUS     every target on its seeds and on the folder CORPUS/TARGET
//   --seeds TARGET   prints the files below tests/data that it starts with
//   --list           prints the names of the targets
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/files/files.hpp"
#include "tests/fuzz/target.hpp"

namespace mapproof::fuzz {
namespace {

namespace fs = std::filesystem;

/// The file, or the files of the folder, in the order of their names.
std::vector<fs::path> files_of(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::vector<fs::path> seeds_of(const Target& target) {
  std::vector<fs::path> files;
  for (const std::string& seed : target.seeds)
    for (const fs::path& file : files_of(fs::path(MAPPROOF_TEST_DATA) / seed))
      files.push_back(file);
  return files;
}

const Target* target_named(const std::string& name) {
  const auto found = std::ranges::find(targets(), name, &Target::name);
  return found == targets().end() ? nullptr : &*found;
}

/// @return 1 if there is no input.
int replay(const Target& target, const std::vector<fs::path>& further) {
  std::vector<fs::path> files = seeds_of(target);
  for (const fs::path& path : further)
    if (fs::exists(path))
      for (const fs::path& file : files_of(path)) files.push_back(file);
  for (const fs::path& file : files) {
    std::printf("%s\n", file.c_str());
    std::fflush(stdout);  // It is the last line if the process ends at this input.
    run(target, read_file(file));
  }
  if (files.empty()) std::fprintf(stderr, "%s has no input\n", target.name.c_str());
  return files.empty() ? 1 : 0;
}

int replay_all(const fs::path& corpus) {
  int code = 0;
  for (const Target& target : targets()) code |= replay(target, {corpus / target.name});
  return code;
}

int main_of(const std::vector<std::string>& words) {
  const std::string first = words.empty() ? "" : words[0];
  if (first == "--list" && words.size() == 1) {
    for (const Target& target : targets()) std::printf("%s\n", target.name.c_str());
    return 0;
  }
  if (first == "--all" && words.size() == 2) return replay_all(words[1]);
  const Target* target =
      words.size() < 2 ? nullptr : target_named(first == "--seeds" ? words[1] : first);
  if (target == nullptr) {
    std::fprintf(stderr, "expected TARGET FILE..., --all CORPUS, --seeds TARGET or --list\n");
    return 2;
  }
  if (first == "--seeds") {
    for (const fs::path& file : seeds_of(*target)) std::printf("%s\n", file.c_str());
    return 0;
  }
  return replay(*target, {words.begin() + 1, words.end()});
}

}  // namespace
}  // namespace mapproof::fuzz

int main(int count, char** words) {
  try {
    return mapproof::fuzz::main_of({words + 1, words + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
