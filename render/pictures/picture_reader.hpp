#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/child_process.hpp"
#include "core/base/files/descriptor.hpp"
#include "render/image/image.hpp"

namespace mapproof {

/// Formats of images that other programs decode: those of FFmpeg's libraries, and PDF.
enum class PictureFormat { kApng, kBmp, kGif, kJpeg, kPdf, kPng, kTiff, kWebp };

/// "JPEG": for readers.
std::string_view label(PictureFormat format);

/// The format by the first bytes, whatever the name of the file; empty: none of these, or a PNG
/// that is not animated.
std::optional<PictureFormat> picture_format(std::string_view bytes);

/// One frame of an animation, one page of a PDF, or a whole image.
struct Picture {
  Image over_white;
  std::optional<Image> over_black;  ///< If the picture has transparent pixels.
  int duration_ms = 0;              ///< Of a frame; 0: it is not animated.
};

/// Reads the pictures of a file one by one: frames are composed as a viewer shows them, the pages
/// of a PDF are drawn at 96 dpi. Programs of their own decode (mapproof-animation, pdftoppm), each
/// with at most a minute of processor time and 4 GiB, so that a damaged file ends no more than
/// these.
class PictureReader {
 public:
  static constexpr int kLargestSide = 32'768;                         ///< Pixels.
  static constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;  ///< Of a picture.

  /// @throws InvalidInput with the reason if the program is missing.
  PictureReader(std::string_view bytes, PictureFormat format);

  /// The next picture; empty after the last.
  /// @throws InvalidInput with the reason if the file is damaged or its pictures exceed the limits.
  std::optional<Picture> next();

 private:
  std::optional<Picture> next_page();
  std::optional<Picture> next_frame();
  std::optional<std::string> line();
  std::string bytes(std::size_t count);
  void require_size(std::int64_t width, std::int64_t height) const;
  void require_end();
  [[noreturn]] void fail(std::string_view otherwise);

  PictureFormat format_;
  Descriptor input_{-1};
  Descriptor messages_{-1};
  Descriptor output_{-1};  ///< The end of a pipe that the program fills.
  std::optional<ChildProcess> process_;
};

}  // namespace mapproof
