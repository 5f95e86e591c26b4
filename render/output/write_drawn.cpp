#include "render/output/write_drawn.hpp"

#include <stdexcept>

#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/out_of_memory.hpp"

namespace mapproof {
namespace {

std::string drawn(const std::filesystem::path& path, const std::function<std::string()>& draw) {
  try {
    return draw();
  } catch (const std::bad_alloc&) {
    throw OutOfMemory(path.string());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace

void write_drawn(const OutputFolder& folder, const std::filesystem::path& file,
                 const std::function<std::string()>& draw) {
  folder.write(file, drawn(folder.path() / file, draw));
}

}  // namespace mapproof
