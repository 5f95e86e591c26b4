// compare_folders OLD NEW: the verdict on each figure or record of two folders. Exit code 1 if one
// of them differs beyond tolerance.
#include <cstdio>
#include <exception>
#include <string>

#include "reports/diff/folder_diff.hpp"

using namespace mapproof;

int main(int count, char** arguments) {
  if (count != 3) return std::fputs("usage: compare_folders OLD NEW\n", stderr), 2;
  try {
    const DiffResult result = folder_diff(arguments[1], arguments[2]);
    for (const DiffItem& item : result.items)
      std::printf("%s: %s\n", item.id.c_str(), std::string(name(item.judgement.verdict)).c_str());
    return result.passes ? 0 : 1;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "compare_folders: %s\n", error.what()), 2;
  }
}
