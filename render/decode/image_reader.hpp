#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/child_process.hpp"
#include "core/base/files/descriptor.hpp"
#include "render/animation/image_decoder.hpp"
#include "render/image/image.hpp"

namespace mapproof {

/// Formats of images that other programs decode: those of FFmpeg's libraries, and PDF.
enum class DecodedFormat { kApng, kBmp, kGif, kJpeg, kPdf, kPng, kTiff, kWebp };

/// "JPEG": for readers.
std::string_view label(DecodedFormat format);

/// The format by the first bytes, whatever the name of the file; empty: none of these, or a PNG
/// that is not animated.
std::optional<DecodedFormat> decoded_format(std::string_view bytes);

/// One frame of an animation, one page of a PDF, or a whole image.
struct DecodedImage {
  Image over_white;
  std::optional<Image> over_black;  ///< If the image has transparent pixels.
  int duration_ms = 0;              ///< Of a frame; 0: it is not animated.
};

/// Reads the images of a file one by one: frames are composed as a viewer shows them, the pages
/// of a PDF are drawn at 96 dpi. Programs of their own decode (mapproof-animation, pdftoppm), each
/// with at most a minute of processor time and 4 GiB, so that a damaged file ends no more than
/// these.
class ImageReader {
 public:
  static constexpr int kLargestSide = 32'768;  ///< Pixels, of at most kMostDecodedPixels.

  /// @throws InvalidInput with the reason if the program is missing.
  ImageReader(std::string_view bytes, DecodedFormat format);

  /// The next image; empty after the last.
  /// @throws InvalidInput with the reason if the file is damaged or its images exceed the limits.
  std::optional<DecodedImage> next();

 private:
  std::optional<DecodedImage> next_page();
  std::optional<DecodedImage> next_frame();
  std::optional<std::string> line();
  std::string bytes(std::size_t count);
  void require_size(std::int64_t width, std::int64_t height) const;
  void require_end();
  [[noreturn]] void fail(std::string_view otherwise);

  DecodedFormat format_;
  Descriptor input_{-1};
  Descriptor messages_{-1};
  Descriptor output_{-1};  ///< The end of a pipe that the program fills.
  std::optional<ChildProcess> process_;
};

/// An SVG as a PNG of twice its size, as librsvg's program rsvg-convert draws it, with at most a
/// minute of processor time and 4 GiB.
/// @throws InvalidInput with the reason if the program is missing or cannot draw it.
std::string drawn_svg(std::string_view bytes);

}  // namespace mapproof
