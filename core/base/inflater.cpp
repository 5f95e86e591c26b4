#include "core/base/inflater.hpp"

#include <zlib.h>

#include <array>
#include <utility>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kMagic = "\x1f\x8b";
constexpr int kGzipWindowBits = 15 + 16;  ///< The largest window, a gzip header.

}  // namespace

void refuse_bomb(const std::string& source, double packed_bytes, double inflated_bytes) {
  constexpr double kHarmless = 64.0 * 1024.0 * 1024.0;
  constexpr double kMostInflation = 300.0;
  if (inflated_bytes > kHarmless && inflated_bytes > kMostInflation * packed_bytes)
    throw IoError(source, "inflates to more than 300 times its size: no table does");
}

struct Inflater::State {
  explicit State(std::string name) : source(std::move(name)) {
    if (::inflateInit2(&stream, kGzipWindowBits) != Z_OK)
      throw IoError(source, "no memory to inflate what is gzip'ed");
  }
  ~State() { ::inflateEnd(&stream); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  enum class Kind { kUnknown, kPlain, kGzip };

  std::string inflate(std::string_view bytes);

  std::string source;
  z_stream stream{};
  Kind kind = Kind::kUnknown;
  std::string start;         ///< Bytes that do not tell yet.
  bool is_in_member = true;  ///< One gzip may follow another.
  double packed = 0.0;
  double inflated = 0.0;
};

std::string Inflater::State::inflate(std::string_view bytes) {
  std::string result;
  std::array<char, 65536> block;
  packed += static_cast<double>(bytes.size());
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  bool is_full = false;
  while (stream.avail_in > 0 || is_full) {
    if (!is_in_member) {
      if (*stream.next_in == 0) {  // Padding behind a member.
        ++stream.next_in;
        --stream.avail_in;
        continue;
      }
      ::inflateReset(&stream);
      is_in_member = true;
    }
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    const int code = ::inflate(&stream, Z_NO_FLUSH);
    if (code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR)
      throw IoError(source, "the gzip'ed bytes are damaged");
    const std::size_t got = block.size() - stream.avail_out;
    result.append(block.data(), got);
    inflated += static_cast<double>(got);
    refuse_bomb(source, packed, inflated);
    is_full = stream.avail_out == 0 && code == Z_OK;
    if (code == Z_STREAM_END) is_in_member = false;
    if (code == Z_BUF_ERROR) break;
  }
  return result;
}

Inflater::Inflater(std::string source) : state_(std::make_unique<State>(std::move(source))) {}

Inflater::~Inflater() = default;

std::string Inflater::take(std::string_view bytes) {
  State& state = *state_;
  if (state.kind == State::Kind::kPlain) return std::string(bytes);
  if (state.kind == State::Kind::kGzip) return state.inflate(bytes);
  state.start += bytes;
  if (kMagic.starts_with(state.start)) return {};  // Its first byte alone, or none.
  const bool is_gzip = state.start.starts_with(kMagic);
  state.kind = is_gzip ? State::Kind::kGzip : State::Kind::kPlain;
  const std::string start = std::exchange(state.start, {});
  return is_gzip ? state.inflate(start) : start;
}

std::string Inflater::end() { return std::exchange(state_->start, {}); }

bool Inflater::is_cut() const { return state_->kind == State::Kind::kGzip && state_->is_in_member; }

}  // namespace mapproof
