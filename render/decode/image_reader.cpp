#include "render/decode/image_reader.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <new>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/out_of_memory.hpp"
#include "render/animation/animation.hpp"
#include "render/image/png_chunks.hpp"

namespace mapproof {
namespace {

using namespace std::string_view_literals;

/// What the program that decodes calls it.
std::string_view name(DecodedFormat format) {
  constexpr std::string_view kNames[] = {"apng", "bmp", "gif",  "jpeg",
                                         "pdf",  "png", "tiff", "webp"};
  return kNames[static_cast<std::size_t>(format)];
}

/// Whether the chunk that says so stands before the pixels.
bool is_animated_png(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kHead = 8, kCheck = 4;
  if (!bytes.starts_with("\x89PNG")) return false;
  for (std::size_t at = kSignature; at + kHead <= bytes.size();) {
    const std::string_view type = bytes.substr(at + 4, 4);
    if (type == "acTL" || type == "IDAT") return type == "acTL";
    at += kHead + big_endian(bytes.substr(at, 4)) + kCheck;
  }
  return false;
}

/// A program that sets no limits of its own, and its arguments: with 4 GiB and a minute at most.
ProgramCall limited(std::vector<std::string> words) {
  words.insert(words.begin(), {"--as=4294967296", "--cpu=60", "--core=0"});
  return {"/usr/bin/prlimit", std::move(words)};
}

/// A file in memory with these bytes, to be read from its start. @throws ProcessError.
Descriptor file_of(std::string_view bytes) {
  Descriptor file = memory_file("mapproof-image");
  if (!write_all(file, bytes) || ::lseek(file.get(), 0, SEEK_SET) != 0)
    throw ProcessError(std::strerror(errno));
  return file;
}

/// Whether prlimit did not find the program, or could not run it.
bool is_missing(const ProcessEnd& end) {
  constexpr int kNotFound = 127, kNotRun = 126;
  return end.exit_code == kNotFound || end.exit_code == kNotRun;
}

ProgramCall program_of(DecodedFormat format) {
  if (format == DecodedFormat::kPdf) return limited({"pdftoppm", "-r", "96", "-"});
  const std::filesystem::path program = animation_program();
  if (!is_program(program))
    throw InvalidInput(fmt::format("{} is read by {}, which is not there", label(format),
                                   program.filename().string()));
  return {program, {"decode", std::string(name(format))}};
}

/// The ends of a pipe that are closed in programs started later.
std::pair<Descriptor, Descriptor> new_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw ProcessError(fmt::format("no pipe: {}", std::strerror(errno)));
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// Numbers separated by blanks; empty if the text is something else.
std::vector<std::int64_t> numbers_in(std::string_view text) {
  std::vector<std::int64_t> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    std::int64_t number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || (next != end && *next != ' ')) return {};
    numbers.push_back(number);
    at = next == end ? end : next + 1;
  }
  return numbers;
}

std::uint32_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

/// A channel of a colour over a ground, rounded to nearest.
std::uint32_t over(std::uint32_t ground, std::uint32_t colour, std::uint32_t alpha) {
  return (colour * alpha + ground * (255 - alpha) + 127) / 255;
}

/// @param rgba  Four bytes a pixel.
Image composed(int width, int height, std::string_view rgba, std::uint32_t ground) {
  Image image{width, height, std::vector<std::uint32_t>(rgba.size() / 4)};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::uint32_t alpha = byte_at(rgba, 4 * i + 3);
    for (std::size_t channel = 0; channel < 3; ++channel)
      image.pixels[i] = image.pixels[i] << 8 | over(ground, byte_at(rgba, 4 * i + channel), alpha);
  }
  return image;
}

bool is_opaque(std::string_view rgba) {
  for (std::size_t at = 3; at < rgba.size(); at += 4)
    if (byte_at(rgba, at) != 255) return false;
  return true;
}

/// Whether the blocks of a GIF are whole up to its trailer: newer decoders take a file that
/// is cut off for a shorter one. Bytes after the trailer are left alone.
bool has_gif_trailer(std::string_view bytes) {
  constexpr std::size_t kHead = 13, kDescriptor = 10;
  const auto table_bytes = [](unsigned flags) -> std::size_t {
    return (flags & 0x80U) != 0 ? std::size_t{3} << ((flags & 7U) + 1) : 0;
  };
  if (bytes.size() < kHead) return false;
  std::size_t at = kHead + table_bytes(byte_at(bytes, 10));
  while (at < bytes.size()) {
    const unsigned block = byte_at(bytes, at);
    if (block == 0x3B) return true;
    if (block == 0x21) {
      at += 2;
    } else if (block == 0x2C && at + kDescriptor <= bytes.size()) {
      at += kDescriptor + table_bytes(byte_at(bytes, at + kDescriptor - 1)) + 1;
    } else {
      return false;
    }
    while (at < bytes.size() && byte_at(bytes, at) != 0) at += 1 + byte_at(bytes, at);
    ++at;
  }
  return false;
}

}  // namespace

std::string_view label(DecodedFormat format) {
  constexpr std::string_view kLabels[] = {"animated PNG", "BMP", "GIF",  "JPEG",
                                          "PDF",          "PNG", "TIFF", "WebP"};
  return kLabels[static_cast<std::size_t>(format)];
}

std::optional<DecodedFormat> decoded_format(std::string_view bytes) {
  constexpr std::size_t kPdfHead = 1024;  // Readers look for its mark that far.
  if (bytes.starts_with("\xFF\xD8\xFF")) return DecodedFormat::kJpeg;
  if (bytes.starts_with("GIF8")) return DecodedFormat::kGif;
  if (bytes.starts_with("BM")) return DecodedFormat::kBmp;
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return DecodedFormat::kTiff;
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP"))
    return DecodedFormat::kWebp;
  if (bytes.substr(0, kPdfHead).find("%PDF-") != std::string_view::npos) return DecodedFormat::kPdf;
  if (is_animated_png(bytes)) return DecodedFormat::kApng;
  return std::nullopt;
}

ImageReader::ImageReader(std::string_view bytes, DecodedFormat format) : format_(format) {
  const ProgramCall call = program_of(format);
  if (format == DecodedFormat::kGif && !has_gif_trailer(bytes))
    throw InvalidInput("GIF cannot be read: it is cut off or damaged, it has no trailer");
  try {
    input_ = file_of(bytes);
    messages_ = memory_file("mapproof-image");
    auto [from, to] = new_pipe();
    process_.emplace(
        call,
        StandardStreams{.input = input_.get(), .output = to.get(), .messages = messages_.get()});
    output_ = std::move(from);
  } catch (const ProcessError& error) {
    throw InvalidInput(fmt::format("{} cannot be read: {}", label(format), error.what()));
  }
}

std::optional<DecodedImage> ImageReader::next() {
  if (!process_) return std::nullopt;
  return format_ == DecodedFormat::kPdf ? next_page() : next_frame();
}

std::optional<DecodedImage> ImageReader::next_page() {
  constexpr std::size_t kChannels = 3;
  const std::optional<std::string> start = line();
  if (!start) {
    require_end();
    return std::nullopt;
  }
  const std::vector<std::int64_t> size = numbers_in(line().value_or(""));
  if (*start != "P6" || size.size() != 2 || line() != "255") fail("its pages cannot be drawn");
  require_size(size[0], size[1]);
  const auto count = static_cast<std::size_t>(size[0] * size[1]);
  const std::string rgb = bytes(kChannels * count);
  Image page{static_cast<int>(size[0]), static_cast<int>(size[1]),
             std::vector<std::uint32_t>(count)};
  for (std::size_t i = 0; i < count; ++i)
    page.pixels[i] = byte_at(rgb, kChannels * i) << 16 | byte_at(rgb, kChannels * i + 1) << 8 |
                     byte_at(rgb, kChannels * i + 2);
  return DecodedImage{.over_white = std::move(page), .over_black = std::nullopt};
}

std::optional<DecodedImage> ImageReader::next_frame() {
  const std::optional<std::string> start = line();
  if (!start || *start == "end") {
    if (!start) fail("it ends too soon");
    require_end();
    return std::nullopt;
  }
  const std::vector<std::int64_t> facts = numbers_in(*start);
  if (facts.size() != 3) fail("its pixels cannot be read");
  require_size(facts[0], facts[1]);
  const int width = static_cast<int>(facts[0]), height = static_cast<int>(facts[1]);
  const std::string rgba = bytes(static_cast<std::size_t>(4 * facts[0] * facts[1]));
  DecodedImage image{.over_white = composed(width, height, rgba, 255),
                     .over_black = std::nullopt,
                     .duration_ms = static_cast<int>(facts[2])};
  if (!is_opaque(rgba)) image.over_black = composed(width, height, rgba, 0);
  return image;
}

/// The next line of the program's output; empty at its end.
std::optional<std::string> ImageReader::line() {
  constexpr std::size_t kLongest = 100;
  std::string text;
  for (char c = 0; text.size() <= kLongest; text += c) {
    const ssize_t got = ::read(output_.get(), &c, 1);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text.empty() ? std::nullopt : std::optional(text);
    if (c == '\n') return text;
  }
  fail("its pixels cannot be read");
}

std::string ImageReader::bytes(std::size_t count) {
  std::string block(count, '\0');
  for (std::size_t done = 0; done < count;) {
    const ssize_t got = ::read(output_.get(), block.data() + done, count - done);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("it ends too soon");
    done += static_cast<std::size_t>(got);
  }
  return block;
}

void ImageReader::require_size(std::int64_t width, std::int64_t height) const {
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestSide ||
      width * height > kMostDecodedPixels)
    throw InvalidInput(fmt::format("{} x {} pixels are more than the {} that are compared", width,
                                   height, kMostDecodedPixels));
}

void ImageReader::require_end() {
  const ProcessEnd end = process_->wait();
  if (!end.is_success()) fail(end.text());
  process_.reset();
}

void ImageReader::fail(std::string_view otherwise) {
  output_ = Descriptor(-1);  // The program ends if it still writes.
  const ProcessEnd end = process_->wait();
  process_.reset();
  const std::string said = last_line(content_of(messages_));
  if (said == kOutOfMemory) throw std::bad_alloc();
  if (format_ == DecodedFormat::kPdf && is_missing(end))
    throw InvalidInput("PDF is drawn by pdftoppm of poppler-utils, which is not installed");
  throw InvalidInput(printable(
      fmt::format("cannot be read as {}: {}", label(format_), said.empty() ? otherwise : said),
      500));
}

std::string drawn_svg(std::string_view bytes) {
  // rsvg-convert sets no limits of its own. Twice the size shows changes of half a pixel.
  const ProgramCall call =
      limited({"rsvg-convert", "--zoom=2", "--format=png", "--background-color=white"});
  try {
    ProgramAnswer answer = answer_of(call, file_of(bytes));
    if (is_missing(answer.end))
      throw InvalidInput("SVG is drawn by rsvg-convert of librsvg2-bin, which is not installed");
    if (!answer.end.is_success())
      throw InvalidInput(printable(
          fmt::format("SVG cannot be drawn: {}",
                      answer.messages.empty() ? answer.end.text() : last_line(answer.messages)),
          500));
    return std::move(answer.output);
  } catch (const ProcessError& error) {
    throw InvalidInput(fmt::format("SVG cannot be drawn: {}", error.what()));
  }
}

}  // namespace mapproof
