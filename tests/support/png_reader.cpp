#include "tests/support/png_reader.hpp"

#include <cstring>
#include <stdexcept>

#include <png.h>

namespace mapproof::test {
namespace {

void take(png_structp png, png_bytep out, std::size_t count) {
  auto& rest = *static_cast<std::string_view*>(png_get_io_ptr(png));
  if (rest.size() < count) png_error(png, "too short");
  std::memcpy(out, rest.data(), count);
  rest.remove_prefix(count);
}

/// libpng's two structures.
struct Handles {
  png_structp png = png_create_read_struct(
      PNG_LIBPNG_VER_STRING, nullptr,
      [](png_structp, png_const_charp what) { throw std::runtime_error(what); },
      [](png_structp, png_const_charp what) { throw std::runtime_error(what); });
  png_infop info = png_create_info_struct(png);
  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() { png_destroy_read_struct(&png, &info, nullptr); }
};

}  // namespace

PngFile read_png(std::string_view bytes) {
  Handles handles;
  png_set_read_fn(handles.png, &bytes, take);
  png_read_png(handles.png, handles.info,
               PNG_TRANSFORM_EXPAND | PNG_TRANSFORM_STRIP_ALPHA | PNG_TRANSFORM_STRIP_16, nullptr);
  PngFile file;
  file.image.width = static_cast<int>(png_get_image_width(handles.png, handles.info));
  file.image.height = static_cast<int>(png_get_image_height(handles.png, handles.info));
  png_bytepp rows = png_get_rows(handles.png, handles.info);
  for (int y = 0; y < file.image.height; ++y)
    for (int x = 0; x < file.image.width; ++x) {
      const png_bytep p = rows[y] + 3 * x;
      file.image.pixels.push_back(static_cast<std::uint32_t>(p[0] << 16 | p[1] << 8 | p[2]));
    }
  png_textp texts = nullptr;
  const int count = png_get_text(handles.png, handles.info, &texts, nullptr);
  for (int i = 0; i < count; ++i) file.texts[texts[i].key] = texts[i].text;
  file.pixels_per_metre = png_get_x_pixels_per_meter(handles.png, handles.info);
  file.has_time = png_get_valid(handles.png, handles.info, PNG_INFO_tIME) != 0;
  return file;
}

}  // namespace mapproof::test
