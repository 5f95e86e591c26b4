#include "core/base/files/unpacker.hpp"

#include <iconv.h>
#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace unpacking {

/// Decodes one compression format piece by piece.
class Decoder {
 public:
  virtual ~Decoder() = default;

  /// Decodes the front of `packed`, and removes from it what was used.
  /// @param is_last  No bytes follow those of `packed`.
  /// @return How many bytes were written to `to`; fewer than its size: all of `packed` was used, or
  ///         what follows is damaged, which the next call throws: so whatever the pieces are, what
  ///         stands before the damage is decoded first.
  /// @throws IoError.
  virtual std::size_t decode(std::string_view& packed, bool is_last, std::span<char> to) = 0;

  /// Whether the packed bytes so far end where a file may end.
  virtual bool is_whole() const = 0;
};

class GzipDecoder : public Decoder {
 public:
  static constexpr std::string_view kName = "gzip";
  static constexpr std::string_view kMagic = "\x1f\x8b";

  explicit GzipDecoder(const std::string& source) : source_(source) {
    constexpr int kGzipWindowBits = 15 + 16;  // The largest window, a gzip header.
    if (::inflateInit2(&stream_, kGzipWindowBits) != Z_OK) throw std::bad_alloc();
  }
  ~GzipDecoder() override { ::inflateEnd(&stream_); }
  GzipDecoder(const GzipDecoder&) = delete;
  GzipDecoder& operator=(const GzipDecoder&) = delete;

  std::size_t decode(std::string_view& packed, bool, std::span<char> to) override {
    stream_.next_out = reinterpret_cast<Bytef*>(to.data());
    stream_.avail_out = static_cast<uInt>(to.size());
    while (damage_.empty() && stream_.avail_out > 0 && begins_member(packed)) {
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
      stream_.avail_in =
          static_cast<uInt>(std::min<std::size_t>(packed.size(), std::numeric_limits<uInt>::max()));
      const std::size_t given = stream_.avail_in;
      const int code = ::inflate(&stream_, Z_NO_FLUSH);
      packed.remove_prefix(given - stream_.avail_in);
      if (code == Z_MEM_ERROR) throw std::bad_alloc();
      if (code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR)
        damage_ = fmt::format("the gzip'ed file is damaged{}{}", stream_.msg == nullptr ? "" : ": ",
                              stream_.msg == nullptr ? "" : stream_.msg);
      if (code == Z_STREAM_END) is_in_member_ = false;
      if (code == Z_BUF_ERROR) break;
    }
    return written_before_damage(to.size() - stream_.avail_out);
  }

  bool is_whole() const override { return !is_in_member_; }

 private:
  /// Skips the padding between members. @return Whether there is more to decode.
  bool begins_member(std::string_view& packed) {
    if (is_in_member_) return true;
    packed.remove_prefix(std::min(packed.find_first_not_of('\0'), packed.size()));
    if (packed.empty()) return false;
    ::inflateReset(&stream_);
    is_in_member_ = true;
    return true;
  }

  std::size_t written_before_damage(std::size_t written) const {
    if (written == 0 && !damage_.empty()) throw IoError(source_, damage_);
    return written;
  }

  const std::string& source_;
  std::string damage_;  ///< Found behind what was decoded; empty: none.
  z_stream stream_{};
  bool is_in_member_ = true;
};

class XzDecoder : public Decoder {
 public:
  static constexpr std::string_view kName = "xz";
  static constexpr std::string_view kMagic = std::string_view("\3757zXZ\0", 6);

  explicit XzDecoder(const std::string& source) : source_(source) {
    if (::lzma_stream_decoder(&stream_, kMostMemory, LZMA_CONCATENATED) != LZMA_OK)
      throw std::bad_alloc();
  }
  ~XzDecoder() override { ::lzma_end(&stream_); }
  XzDecoder(const XzDecoder&) = delete;
  XzDecoder& operator=(const XzDecoder&) = delete;

  std::size_t decode(std::string_view& packed, bool is_last, std::span<char> to) override {
    stream_.next_out = reinterpret_cast<std::uint8_t*>(to.data());
    stream_.avail_out = to.size();
    stream_.next_in = reinterpret_cast<const std::uint8_t*>(packed.data());
    stream_.avail_in = packed.size();
    lzma_ret code = LZMA_OK;
    // After the last input lzma_code() is called once more, without progress, to find the end.
    while (code == LZMA_OK && !is_over_ && !is_damaged_ && stream_.avail_out > 0 &&
           (stream_.avail_in > 0 || is_last))
      code = ::lzma_code(&stream_, is_last ? LZMA_FINISH : LZMA_RUN);
    packed.remove_prefix(packed.size() - stream_.avail_in);
    is_over_ = is_over_ || code == LZMA_STREAM_END;
    if (code == LZMA_MEM_ERROR) throw std::bad_alloc();
    if (code == LZMA_MEMLIMIT_ERROR)
      throw IoError(source_, "the xz'ed file takes more than 128 MB of memory to unpack");
    is_damaged_ =
        is_damaged_ || (code != LZMA_OK && code != LZMA_STREAM_END && code != LZMA_BUF_ERROR);
    const std::size_t written = to.size() - stream_.avail_out;
    if (is_damaged_ && written == 0) throw IoError(source_, "the xz'ed file is damaged");
    return written;
  }

  bool is_whole() const override { return is_over_; }

 private:
  static constexpr std::uint64_t kMostMemory = std::uint64_t{128} << 20;  ///< xz -9 takes 65 MB.

  const std::string& source_;
  lzma_stream stream_ = LZMA_STREAM_INIT;
  bool is_over_ = false;
  bool is_damaged_ = false;  ///< Behind what was decoded.
};

/// Text of UTF-16 with a byte order mark, as UTF-8.
class Utf16Decoder : public Decoder {
 public:
  static constexpr std::string_view kName = "UTF-16";

  explicit Utf16Decoder(const std::string& source)
      : source_(source), converter_(::iconv_open("UTF-8", "UTF-16")) {
    if (std::bit_cast<std::intptr_t>(converter_) == -1) throw std::bad_alloc();
  }
  ~Utf16Decoder() override { ::iconv_close(converter_); }
  Utf16Decoder(const Utf16Decoder&) = delete;
  Utf16Decoder& operator=(const Utf16Decoder&) = delete;

  std::size_t decode(std::string_view& packed, bool, std::span<char> to) override {
    std::size_t written = 0;
    while (written < to.size() && (!ready_.empty() || convert(packed))) {
      const std::size_t part = std::min(ready_.size(), to.size() - written);
      std::copy_n(ready_.begin(), part, to.begin() + static_cast<std::ptrdiff_t>(written));
      ready_.erase(0, part);
      written += part;
    }
    return written;
  }

  bool is_whole() const override { return rest_.empty() && ready_.empty(); }

 private:
  /// Fills ready_ from the front of `packed`. @return False if nothing was converted.
  bool convert(std::string_view& packed) {
    constexpr std::size_t kBlock = 4096;
    const std::size_t taken = std::min(packed.size(), kBlock);
    rest_ += packed.substr(0, taken);
    packed.remove_prefix(taken);
    std::array<char, 4 * kBlock> room{};
    char* from = rest_.data();
    char* to = room.data();
    std::size_t left = rest_.size(), free = room.size();
    const bool is_broken =
        ::iconv(converter_, &from, &left, &to, &free) == static_cast<std::size_t>(-1) &&
        errno == EILSEQ;
    if (is_broken) throw IoError(source_, "is UTF-16 with characters that are none");
    rest_.erase(0, rest_.size() - left);
    ready_.assign(room.data(), room.size() - free);
    return !ready_.empty() || taken > 0;
  }

  const std::string& source_;
  iconv_t converter_;
  std::string rest_;   ///< Bytes of a character that is not complete.
  std::string ready_;  ///< Converted.
};

class Utf16LittleEndian : public Utf16Decoder {
 public:
  static constexpr std::string_view kMagic = "\xFF\xFE";
  using Utf16Decoder::Utf16Decoder;
};

class Utf16BigEndian : public Utf16Decoder {
 public:
  static constexpr std::string_view kMagic = "\xFE\xFF";
  using Utf16Decoder::Utf16Decoder;
};

}  // namespace unpacking

namespace {

constexpr std::size_t kUnpackedBlock = std::size_t{1} << 16;

}  // namespace

void refuse_bomb(const std::string& source, double packed_bytes, double unpacked_bytes) {
  constexpr double kHarmless = 64.0 * 1024.0 * 1024.0;
  constexpr double kMostSwelling = 300.0;
  if (unpacked_bytes > kHarmless && unpacked_bytes > kMostSwelling * packed_bytes)
    throw IoError(source, "unpacks to more than 300 times its size: no table does");
}

struct Unpacker::State {
  explicit State(std::string name) : source(std::move(name)) {}

  /// Whether the input may be of this format; makes its decoder as soon as the first bytes show it.
  template <typename Way>
  bool may_be() {
    if (packed().size() < Way::kMagic.size()) return !is_ended && Way::kMagic.starts_with(packed());
    if (!packed().starts_with(Way::kMagic)) return false;
    decoder = std::make_unique<Way>(source);
    packing = Way::kName;
    return true;
  }

  void choose() {
    if (is_known) return;
    const bool is_open =
        (!is_unpacked && (may_be<unpacking::GzipDecoder>() || may_be<unpacking::XzDecoder>())) ||
        may_be<unpacking::Utf16LittleEndian>() || may_be<unpacking::Utf16BigEndian>();
    is_known = decoder != nullptr || !is_open;
    if (decoder && packing != unpacking::Utf16Decoder::kName) {
      text = std::make_unique<Unpacker>(source);
      text->state_->is_unpacked = true;
    }
  }

  /// Appends up to `count` bytes to `bytes`; fewer: all of `packed` was used.
  std::size_t decode(std::string_view& packed, std::string& bytes, std::size_t count) {
    room.resize(kUnpackedBlock);
    for (std::size_t added = 0;;) {
      const std::size_t wanted = std::min(room.size(), count - added);
      const std::size_t got =
          decoder->decode(packed, is_ended, std::span<char>(room).first(wanted));
      bytes.append(room, 0, got);
      added += got;
      if (got < wanted || added == count) return added;
    }
  }

  /// decode(), with text of UTF-16 as UTF-8.
  std::size_t decode_text(std::string_view& packed, std::string& bytes, std::size_t count) {
    std::size_t added = text->drain(bytes, count);
    for (std::string block; added < count; block.clear()) {
      if (decode(packed, block, kUnpackedBlock) > 0)
        text->feed(block);
      else if (is_ended && !std::exchange(is_text_ended, true))
        text->end();
      else
        break;
      added += text->drain(bytes, count - added);
    }
    return added;
  }

  /// The fed bytes that are not used yet.
  std::string_view packed() const { return std::string_view(fed).substr(used); }

  std::string source;
  std::string fed;
  std::size_t used = 0;
  bool is_ended = false;
  bool is_known = false;
  bool is_unpacked = false;                     ///< The input was unpacked already.
  bool is_text_ended = false;                   ///< `text` knows that no more comes.
  std::unique_ptr<unpacking::Decoder> decoder;  ///< Null: the bytes pass unchanged.
  std::unique_ptr<Unpacker> text;               ///< Of what gzip or xz held; else null.
  std::string room;                             ///< Buffer of decoded bytes.
  std::string_view packing = {};
  double packed_bytes = 0.0;
  double unpacked_bytes = 0.0;
};

Unpacker::Unpacker(std::string source) : state_(std::make_unique<State>(std::move(source))) {}

Unpacker::~Unpacker() = default;
Unpacker::Unpacker(Unpacker&&) noexcept = default;
Unpacker& Unpacker::operator=(Unpacker&&) noexcept = default;

void Unpacker::feed(std::string_view packed) {
  State& state = *state_;
  state.fed.erase(0, std::exchange(state.used, 0));
  state.fed += packed;
  state.packed_bytes += static_cast<double>(packed.size());
}

void Unpacker::end() { state_->is_ended = true; }

std::size_t Unpacker::drain(std::string& bytes, std::size_t count) {
  State& state = *state_;
  state.choose();
  if (!state.is_known) return 0;
  std::string_view packed = state.packed();
  const std::size_t added = state.text      ? state.decode_text(packed, bytes, count)
                            : state.decoder ? state.decode(packed, bytes, count)
                                            : std::min(count, packed.size());
  if (!state.decoder) {
    bytes += packed.substr(0, added);
    packed.remove_prefix(added);
  }
  state.used = state.fed.size() - packed.size();
  state.unpacked_bytes += static_cast<double>(added);
  if (state.decoder) refuse_bomb(state.source, state.packed_bytes, state.unpacked_bytes);
  return added;
}

std::string Unpacker::take(std::string_view packed) {
  feed(packed);
  std::string bytes;
  while (drain(bytes, kUnpackedBlock) == kUnpackedBlock) {
  }
  return bytes;
}

std::string_view Unpacker::packing() const { return state_->packing; }

bool Unpacker::is_passing() const {
  return state_->is_known && !state_->decoder && state_->packed().empty();
}

bool Unpacker::is_cut() const {
  return state_->decoder &&
         (!state_->decoder->is_whole() || (state_->text && state_->text->is_cut()));
}

double Unpacker::ratio() const {
  const double used = state_->packed_bytes - static_cast<double>(state_->packed().size());
  return used > 0.0 && state_->unpacked_bytes > 0.0 ? state_->unpacked_bytes / used : 1.0;
}

std::string zlib_start(std::string_view packed, std::size_t most) {
  std::string start(most, '\0');
  z_stream stream{};
  if (::inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(start.data());
  stream.avail_out = static_cast<uInt>(start.size());
  ::inflate(&stream, Z_SYNC_FLUSH);
  start.resize(start.size() - stream.avail_out);
  ::inflateEnd(&stream);
  return start;
}

}  // namespace mapproof
