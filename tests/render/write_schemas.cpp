#include <cstdio>
#include <filesystem>

#include "core/base/files/files.hpp"
#include "tests/support/schemas/comparison_schemas.hpp"
#include "tests/support/schemas/drawing_schemas.hpp"
#include "tests/support/schemas/file_schemas.hpp"

/// Writes into a folder the schemas that the code makes.
int main(int argc, char** argv) {
  using namespace mapproof;
  if (argc != 2) {
    std::fputs("usage: write_schemas FOLDER\n", stderr);
    return 2;
  }
  for (const auto& schemas :
       {test::comparison_schemas(), test::drawing_schemas(), test::file_schemas()})
    for (const auto& [name, text] : schemas)
      write_file(std::filesystem::path(argv[1]) / name, text);
}
