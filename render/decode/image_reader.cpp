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
#include "render/image/png_read.hpp"

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

/// @param rgba  Four bytes a pixel, which fill the image.
Image composed(int width, std::string_view rgba, std::uint32_t ground) {
  Image image{width, 0, std::vector<std::uint32_t>(rgba.size() / 4)};
  image.height = static_cast<int>(image.pixels.size() / static_cast<std::size_t>(width));
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

/// @param rgb  Three bytes a pixel, which fill the image.
Image opaque(int width, std::string_view rgb) {
  Image image{width, 0, std::vector<std::uint32_t>(rgb.size() / 3)};
  image.height = static_cast<int>(image.pixels.size() / static_cast<std::size_t>(width));
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] =
        byte_at(rgb, 3 * i) << 16 | byte_at(rgb, 3 * i + 1) << 8 | byte_at(rgb, 3 * i + 2);
  return image;
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

/// Some 4 million pixels.
int rows_at_once(int width) { return std::max(1, (1 << 22) / width); }

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
  if (format == DecodedFormat::kPng)
    start_png(bytes);
  else
    start_program(bytes);
}

void ImageReader::start_png(std::string_view bytes) {
  const PngHeader header = read_png_remarks(bytes).header;
  if (header.interlace != 0 && !is_held_whole(header)) return start_program(bytes);
  head_ = {.width = static_cast<int>(header.width), .height = static_cast<int>(header.height)};
  png_.emplace(png_chunks(bytes));
  is_png_pending_ = true;
}

void ImageReader::start_program(std::string_view bytes) {
  const ProgramCall call = program_of(format_);
  if (format_ == DecodedFormat::kGif && !has_gif_trailer(bytes))
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
    throw InvalidInput(fmt::format("{} cannot be read: {}", label(format_), error.what()));
  }
}

std::optional<ImageHead> ImageReader::next() {
  while (rows_left_ > 0) rows(std::min(rows_left_, rows_at_once(head_.width)));
  if (png_) {
    if (!std::exchange(is_png_pending_, false)) return std::nullopt;
    rows_left_ = head_.height;
    return head_;
  }
  if (!process_) return std::nullopt;
  const std::optional<ImageHead> head = format_ == DecodedFormat::kPdf ? next_page() : next_frame();
  if (head) {
    head_ = *head;
    rows_left_ = head->height;
  }
  return head;
}

ImageStrip ImageReader::rows(int count) {
  rows_left_ -= count;
  const std::size_t pixels =
      static_cast<std::size_t>(count) * static_cast<std::size_t>(head_.width);
  if (png_) {
    Image white{head_.width, count, std::vector<std::uint32_t>(pixels)}, black = white;
    const bool is_opaque = png_->read(count, white.pixels.data(), black.pixels.data());
    if (rows_left_ == 0) png_->finish();
    ImageStrip strip{.over_white = std::move(white), .over_black = std::nullopt};
    if (!is_opaque) strip.over_black = std::move(black);
    return strip;
  }
  if (format_ == DecodedFormat::kPdf)
    return {.over_white = opaque(head_.width, bytes(3 * pixels)), .over_black = std::nullopt};
  const std::string rgba = bytes(4 * pixels);
  ImageStrip strip{.over_white = composed(head_.width, rgba, 255), .over_black = std::nullopt};
  if (!is_opaque(rgba)) strip.over_black = composed(head_.width, rgba, 0);
  return strip;
}

std::optional<ImageHead> ImageReader::next_page() {
  const std::optional<std::string> start = line();
  if (!start) {
    require_end();
    return std::nullopt;
  }
  const std::vector<std::int64_t> size = numbers_in(line().value_or(""));
  if (*start != "P6" || size.size() != 2 || line() != "255") fail("its pages cannot be drawn");
  require_size(size[0], size[1]);
  return ImageHead{.width = static_cast<int>(size[0]), .height = static_cast<int>(size[1])};
}

std::optional<ImageHead> ImageReader::next_frame() {
  const std::optional<std::string> start = line();
  if (!start || *start == "end") {
    if (!start) fail("it ends too soon");
    require_end();
    return std::nullopt;
  }
  const std::vector<std::int64_t> facts = numbers_in(*start);
  if (facts.size() != 4) fail("its pixels cannot be read");
  require_size(facts[0], facts[1]);
  return ImageHead{.width = static_cast<int>(facts[0]),
                   .height = static_cast<int>(facts[1]),
                   .duration_ms = static_cast<int>(facts[2]),
                   .profile = static_cast<std::uint64_t>(facts[3])};
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
  if (const std::string problem = decoded_size_problem(width, height); !problem.empty())
    throw InvalidInput(problem);
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

void require_readable(std::string_view bytes, DecodedFormat format) {
  if (format == DecodedFormat::kPng && is_held_whole(read_png_remarks(bytes).header)) {
    read_png(bytes);  // Faster than row by row.
    return;
  }
  ImageReader reader(bytes, format);
  while (reader.next()) continue;
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
