#include "tests/support/images/apng_reader.hpp"

#include <png.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mapproof::test {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr unsigned kDisposeNone = 0, kDisposeBackground = 1;

std::uint32_t number_at(std::string_view bytes, std::size_t at, int count = 4) {
  std::uint32_t number = 0;
  for (int i = 0; i < count; ++i)
    number = number << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
  return number;
}

std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift);
  return bytes;
}

std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t sum = 0xFFFFFFFF;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (0xEDB88320U & (0U - (sum & 1)));
  }
  return ~sum;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data +
         big_endian(checksum(type + data));
}

/// Where a frame stands and how it is aligned to.
struct Control {
  std::uint32_t width, height, x, y;
  double seconds;
  unsigned dispose, blend;
};

Control control_of(std::string_view data) {
  const double denominator = number_at(data, 22, 2);
  return {.width = number_at(data, 4),
          .height = number_at(data, 8),
          .x = number_at(data, 12),
          .y = number_at(data, 16),
          .seconds = number_at(data, 20, 2) / (denominator == 0.0 ? 100.0 : denominator),
          .dispose = number_at(data, 24, 1),
          .blend = number_at(data, 25, 1)};
}

/// RGBA of one frame.
std::vector<std::uint8_t> decoded(const std::string& header, const Control& control,
                                  const std::string& before, const std::string& data) {
  std::string own = header;
  own.replace(0, 8, big_endian(control.width) + big_endian(control.height));
  const std::string file = std::string(kSignature) + chunk("IHDR", own) + before +
                           chunk("IDAT", data) + chunk("IEND", "");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, file.data(), file.size()))
    throw std::runtime_error(png.message);
  png.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  if (!png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr))
    throw std::runtime_error(png.message);
  return pixels;
}

class Viewer {
 public:
  explicit Viewer(std::string_view bytes) : bytes_(bytes) {}

  Apng read() {
    if (!bytes_.starts_with(kSignature)) throw std::runtime_error("no PNG");
    for (std::size_t at = 8; at < bytes_.size();) {
      const std::size_t size = number_at(bytes_, at);
      const std::string_view content = bytes_.substr(at + 4, size + 4);
      if (content.size() != size + 4 || checksum(content) != number_at(bytes_, at + 8 + size))
        throw std::runtime_error("a damaged chunk");
      take(std::string(content.substr(0, 4)), std::string(content.substr(4)));
      at += size + 12;
    }
    if (!ended_ || announced_ != apng_.frames.size())
      throw std::runtime_error("a frame is missing");
    return std::move(apng_);
  }

 private:
  void take(const std::string& type, const std::string& data) {
    if (type == "IHDR") {
      header_ = data;
      screen_ = {static_cast<int>(number_at(data, 0)), static_cast<int>(number_at(data, 4)), {}};
      screen_.pixels.assign(static_cast<std::size_t>(screen_.width) * screen_.height, 0);
    } else if (type == "acTL") {
      announced_ = number_at(data, 0);
      apng_.plays = number_at(data, 4);
    } else if (type == "PLTE" || type == "tRNS") {
      before_ += chunk(type, data);
    } else if (type == "fcTL") {
      show();
      check_order(data);
      control_ = control_of(data);
      has_control_ = true;
    } else if (type == "IDAT") {
      data_ += data;
    } else if (type == "fdAT") {
      check_order(data);
      data_ += data.substr(4);
    } else if (type == "IEND") {
      show();
      ended_ = true;
    }
  }

  void check_order(const std::string& data) {
    if (number_at(data, 0) != sequence_++) throw std::runtime_error("chunks out of order");
  }

  /// Lays the frame that was read on the screen.
  void show() {
    if (!has_control_) return;
    has_control_ = false;
    const std::vector<std::uint8_t> pixels =
        decoded(header_, control_, before_, std::exchange(data_, {}));
    const std::vector<std::uint32_t> earlier = screen_.pixels;
    std::size_t next = 0;
    for (std::uint32_t y = 0; y < control_.height; ++y)
      for (std::uint32_t x = 0; x < control_.width; ++x, next += 4) {
        const std::uint8_t* p = &pixels[next];
        std::uint32_t& to =
            screen_.pixels.at((control_.y + y) * std::size_t(screen_.width) + control_.x + x);
        if (p[3] != 0 && p[3] != 255) throw std::runtime_error("half a pixel");
        if (control_.blend == 0 || p[3] == 255)
          to = std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2];
      }
    apng_.frames.push_back({screen_, control_.seconds});
    if (control_.dispose == kDisposeNone) return;
    for (std::uint32_t y = 0; y < control_.height; ++y)
      for (std::uint32_t x = 0; x < control_.width; ++x) {
        const std::size_t at = (control_.y + y) * std::size_t(screen_.width) + control_.x + x;
        screen_.pixels.at(at) = control_.dispose == kDisposeBackground ? 0 : earlier.at(at);
      }
  }

  std::string_view bytes_;
  Apng apng_;
  Image screen_;
  Control control_{};
  std::string header_, before_, data_;
  std::size_t announced_ = 0;
  std::uint32_t sequence_ = 0;
  bool has_control_ = false;
  bool ended_ = false;
};

}  // namespace

Apng read_apng(const std::string& bytes) { return Viewer(bytes).read(); }

}  // namespace mapproof::test
