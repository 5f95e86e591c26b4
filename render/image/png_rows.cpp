#include "render/image/png_rows.hpp"

#include <algorithm>
#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include <png.h>

#include "core/base/errors.hpp"

namespace mapproof {

/// What libpng is given: signature, header, palette, tRNS and rows, so that no profile and no text
/// is ever inflated.
struct PngSource {
  std::vector<PngChunk> chunks;
  std::size_t next = 0;
  std::string_view rest = kPngSignature;
  std::string reason = {};
  bool is_out_of_memory = false;
};

namespace {

bool is_needed(std::string_view type) {
  return type == "IHDR" || type == "PLTE" || type == "tRNS" || type == "IDAT" || type == "IEND";
}

void take(png_structp png, png_bytep out, std::size_t count) {
  auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  while (count > 0) {
    while (source.rest.empty()) {
      if (source.next == source.chunks.size()) png_error(png, "its rows end early");
      const PngChunk& chunk = source.chunks[source.next++];
      if (is_needed(chunk.type)) source.rest = chunk.whole;
    }
    const std::size_t part = std::min(count, source.rest.size());
    std::memcpy(out, source.rest.data(), part);
    source.rest.remove_prefix(part);
    out += part;
    count -= part;
  }
}

void leave(png_structp png, png_const_charp why) {
  static_cast<PngSource*>(png_get_error_ptr(png))->reason = why;
  png_longjmp(png, 1);
}

void no_warning(png_structp, png_const_charp) {}

png_voidp allocate(png_structp png, png_alloc_size_t bytes) {
  void* memory = std::malloc(bytes);
  if (!memory) static_cast<PngSource*>(png_get_mem_ptr(png))->is_out_of_memory = true;
  return memory;
}

void release(png_structp, png_voidp memory) { std::free(memory); }

/// Lays `colour` over a ground, both of `most`, as 0 to 255.
std::uint32_t over(std::uint32_t ground, std::uint32_t colour, std::uint32_t alpha,
                   std::uint32_t most) {
  const std::uint64_t sum = std::uint64_t{colour} * alpha + std::uint64_t{ground} * (most - alpha);
  const std::uint64_t square = std::uint64_t{most} * most;
  return static_cast<std::uint32_t>((sum * 255 + square / 2) / square);
}

void mix(std::uint64_t& digest, std::uint64_t value) {
  digest = (digest ^ value) * 0x9E3779B97F4A7C15u;
  digest ^= digest >> 29;
}

/// Red, green, blue and alpha of a pixel.
struct Colour {
  std::uint32_t value[4];
  std::uint32_t most;  ///< Of a value: 255 or 65535.

  std::uint32_t over_white() const { return over_ground(most); }
  std::uint32_t over_black() const { return over_ground(0); }
  /// @param ground  0 to `most`.
  std::uint32_t over_ground(std::uint32_t ground) const {
    std::uint32_t pixel = 0;
    for (int c = 0; c < 3; ++c) pixel = pixel << 8 | over(ground, value[c], value[3], most);
    return pixel;
  }
  /// In 16 bits a value. Samples of 16 bits that repeat a byte are those of 8.
  std::uint64_t exact() const {
    std::uint64_t all = 0;
    for (const std::uint32_t one : value) all = all << 16 | (most == 255 ? one * 0x101u : one);
    return all;
  }
};

Colour colour_at(const unsigned char* p, bool is_deep) {
  Colour colour{{}, is_deep ? 0xFFFFu : 0xFFu};
  for (int c = 0; c < 4; ++c) colour.value[c] = is_deep ? p[2 * c] << 8u | p[2 * c + 1] : p[c];
  return colour;
}

/// What `exact` is of an opaque pixel of 8 bits.
std::uint64_t exact_of(std::uint32_t pixel) {
  std::uint64_t all = 0xFFFF;
  for (const int shift : {0, 8, 16})
    all |= std::uint64_t{((pixel >> shift) & 0xFF) * 0x101u} << (16 + 2 * shift);
  return all;
}

}  // namespace

/// libpng's state, and rows of red, green, blue and alpha, of 8 or 16 bits each, the same for every
/// kind of PNG: one after the other, all of them only if they are interlaced.
class PngRows::Decoder {
 public:
  explicit Decoder(std::vector<PngChunk> chunks) : source_{.chunks = std::move(chunks)} {
    png_ = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &source_, leave, no_warning, &source_,
                                    allocate, release);
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (!info_) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &source_, take);
    try {
      require(start());
      width_ = static_cast<int>(png_get_image_width(png_, info_));
      const std::size_t height = is_interlaced_ ? png_get_image_height(png_, info_) : 1;
      bytes_.resize(bytes_a_row_ * height);
      for (std::size_t y = 0; y < height; ++y) rows_.push_back(bytes_.data() + y * bytes_a_row_);
      if (is_interlaced_) require(read_all());
    } catch (...) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw;
    }
  }
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  bool read(int count, std::uint32_t* over_white, std::uint32_t* over_black) {
    bool is_opaque = true;
    for (int row = 0; row < count; ++row, ++next_) {
      if (!is_interlaced_) require(read_row());
      const unsigned char* p = rows_[is_interlaced_ ? next_ : 0];
      for (int x = 0; x < width_; ++x, p += is_deep_ ? 8 : 4) {
        if (!is_deep_ && p[3] == 0xFF) {
          const std::uint32_t pixel = std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2];
          *over_white++ = pixel;
          if (over_black) *over_black++ = pixel;
          continue;
        }
        const Colour colour = colour_at(p, is_deep_);
        const std::uint32_t pixel = colour.over_white();
        *over_white++ = pixel;
        if (over_black) *over_black++ = colour.over_black();
        is_opaque = is_opaque && colour.value[3] == colour.most;
        const std::uint64_t exact = colour.exact();
        if (exact == exact_of(pixel)) continue;
        mix(finer_digest_, std::uint64_t{next_} << 32 | static_cast<unsigned>(x));
        mix(finer_digest_, exact);
      }
    }
    return is_opaque;
  }

  void finish() { require(read_end()); }
  std::uint64_t finer_digest() const { return finer_digest_; }

 private:
  void require(bool is_done) const {
    if (source_.is_out_of_memory) throw std::bad_alloc();
    if (!is_done) throw InvalidInput("its pixels cannot be decoded: " + source_.reason);
  }

  // Nothing with a destructor may live in these: libpng leaves by longjmp.
  bool start() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_benign_errors(png_, 0);
    png_set_crc_action(png_, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
    png_set_user_limits(png_, 0x7FFFFFFF, 0x7FFFFFFF);
    png_read_info(png_, info_);
    png_set_expand(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xFFFF, PNG_FILLER_AFTER);
    is_interlaced_ = png_set_interlace_handling(png_) > 1;
    png_read_update_info(png_, info_);
    bytes_a_row_ = png_get_rowbytes(png_, info_);
    is_deep_ = png_get_bit_depth(png_, info_) == 16;
    return true;
  }
  bool read_all() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_read_image(png_, rows_.data());
    return true;
  }
  bool read_row() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_read_row(png_, bytes_.data(), nullptr);
    return true;
  }
  bool read_end() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_read_end(png_, nullptr);
    return true;
  }

  PngSource source_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::size_t bytes_a_row_ = 0;
  bool is_deep_ = false, is_interlaced_ = false;
  int width_ = 0;
  std::vector<unsigned char> bytes_;
  std::vector<png_bytep> rows_;
  std::size_t next_ = 0;  ///< Row.
  std::uint64_t finer_digest_ = 0;
};

PngRows::PngRows(std::vector<PngChunk> chunks)
    : decoder_(std::make_unique<Decoder>(std::move(chunks))) {}
PngRows::~PngRows() = default;
PngRows::PngRows(PngRows&&) noexcept = default;
PngRows& PngRows::operator=(PngRows&&) noexcept = default;

bool PngRows::read(int count, std::uint32_t* over_white, std::uint32_t* over_black) {
  return decoder_->read(count, over_white, over_black);
}
void PngRows::finish() { decoder_->finish(); }
std::uint64_t PngRows::finer_digest() const { return decoder_->finer_digest(); }

}  // namespace mapproof
