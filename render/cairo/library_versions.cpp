#include "render/cairo/library_versions.hpp"

#include <cairo.h>
#include <fmt/format.h>
#include <ft2build.h>
#include <hb.h>
#include <libdeflate.h>
#include FT_FREETYPE_H

namespace mapproof {
namespace {

std::string freetype_version() {
  FT_Library library = nullptr;
  if (FT_Init_FreeType(&library) != 0) return "unknown";
  int major = 0;
  int minor = 0;
  int patch = 0;
  FT_Library_Version(library, &major, &minor, &patch);
  FT_Done_FreeType(library);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> render_library_versions() {
  return {{"Cairo", cairo_version_string()},
          {"FreeType", freetype_version()},
          {"HarfBuzz", hb_version_string()},
          {"libdeflate", LIBDEFLATE_VERSION_STRING}};
}

}  // namespace mapproof
