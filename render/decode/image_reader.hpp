#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/child_process.hpp"
#include "core/base/files/descriptor.hpp"
#include "render/animation/image_decoder.hpp"
#include "render/image/image.hpp"
#include "render/image/png_rows.hpp"

namespace mapproof {

/// Formats of images that other programs decode: those of FFmpeg's libraries, and PDF.
enum class DecodedFormat { kApng, kBmp, kGif, kJpeg, kPdf, kPng, kTiff, kWebp };

/// "JPEG": for readers.
std::string_view label(DecodedFormat format);

/// The format by the first bytes, whatever the name of the file; empty: none of these, or a PNG
/// that is not animated.
std::optional<DecodedFormat> decoded_format(std::string_view bytes);

/// One frame of an animation, one page of a PDF, or a whole image.
struct ImageHead {
  int width = 0;
  int height = 0;
  int duration_ms = 0;        ///< Of a frame; 0: it is not animated.
  std::uint64_t profile = 0;  ///< A digest of its ICC profile; 0: it has none, or is a PNG.
};

/// Rows of an image.
struct ImageStrip {
  Image over_white;
  std::optional<Image> over_black;  ///< If some of the pixels are transparent.
};

/// Reads the images of a file one by one, each in strips: frames are composed as a viewer shows
/// them, the pages of a PDF are drawn at 96 dpi. Programs of their own decode (mapproof-animation,
/// pdftoppm), each with at most a minute of processor time and 4 GiB, so that a damaged file ends
/// no more than these; their frames have the sizes of decoded_size_problem(). PNGs that are not
/// animated are decoded here, row by row, but for interlaced ones that are not held whole
/// (png_read.hpp).
class ImageReader {
 public:
  /// @param bytes  Must outlive this. @throws InvalidInput with the reason if the program is
  ///               missing, or a PNG is damaged or too large.
  ImageReader(std::string_view bytes, DecodedFormat format);

  /// The next image; empty after the last. Rows of the one before that were not read are left out.
  /// @throws InvalidInput with the reason if the file is damaged or its images exceed the limits.
  std::optional<ImageHead> next();

  /// The next rows of the image. @param count  At most those that are left. @throws as next().
  ImageStrip rows(int count);

  /// As PngFile::finer_digest, of the rows so far; 0 of other formats.
  std::uint64_t finer_digest() const { return png_ ? png_->finer_digest() : 0; }

 private:
  void start_png(std::string_view bytes);
  void start_program(std::string_view bytes);
  std::optional<ImageHead> next_page();
  std::optional<ImageHead> next_frame();
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
  std::optional<PngRows> png_;
  bool is_png_pending_ = false;  ///< Its one image is still to come.
  ImageHead head_;
  int rows_left_ = 0;
};

/// Reads a file whole, and keeps nothing of it. @throws InvalidInput as ImageReader.
void require_readable(std::string_view bytes, DecodedFormat format);

/// An SVG as a PNG of twice its size, as librsvg's program rsvg-convert draws it, with at most a
/// minute of processor time and 4 GiB.
/// @throws InvalidInput with the reason if the program is missing or cannot draw it.
std::string drawn_svg(std::string_view bytes);

}  // namespace mapproof
