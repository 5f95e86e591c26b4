#include "render/animation/image_decoder.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

extern "C" {
#include <libavformat/avformat.h>
}
#include <webp/demux.h>

#include "render/animation/ffmpeg.hpp"

namespace mapproof {
namespace {

/// What the formats differ in.
struct Traits {
  std::string_view name;
  AVCodecID codec;
  const char* demuxer;  ///< Of animations; null: the file is one packet.
};

constexpr std::array kTraits = {
    Traits{"apng", AV_CODEC_ID_APNG, "apng"}, Traits{"bmp", AV_CODEC_ID_BMP, nullptr},
    Traits{"gif", AV_CODEC_ID_GIF, "gif"},    Traits{"jpeg", AV_CODEC_ID_MJPEG, nullptr},
    Traits{"png", AV_CODEC_ID_PNG, nullptr},  Traits{"tiff", AV_CODEC_ID_TIFF, nullptr},
    Traits{"webp", AV_CODEC_ID_WEBP, nullptr}};

const Traits& traits_of(std::string_view format) {
  const auto found = std::ranges::find(kTraits, format, &Traits::name);
  if (found == kTraits.end()) throw std::runtime_error("no such format");
  return *found;
}

/// @throws std::bad_alloc; std::runtime_error: the file is not what its first bytes say.
int decoded(int answer) {
  if (answer >= 0) return answer;
  if (answer == AVERROR(ENOMEM)) throw std::bad_alloc();
  if (answer == AVERROR_PATCHWELCOME) throw std::runtime_error("FFmpeg does not read this kind");
  throw std::runtime_error("it is damaged");
}

Codec opened_codec(const Traits& traits, const AVCodecParameters* facts) {
  const AVCodec* kind = avcodec_find_decoder(traits.codec);
  if (kind == nullptr) throw std::runtime_error("FFmpeg has no decoder of it");
  Codec codec(made(avcodec_alloc_context3(kind)));
  if (facts != nullptr) decoded(avcodec_parameters_to_context(codec.get(), facts));
  codec->thread_count = 1;
  codec->max_pixels = kMostDecodedPixels;
  // What cannot be decoded whole is refused, not guessed.
  codec->err_recognition = AV_EF_CRCCHECK | AV_EF_BITSTREAM | AV_EF_BUFFER | AV_EF_EXPLODE;
  codec->error_concealment = 0;
  checked(avcodec_open2(codec.get(), kind, nullptr), "decoder");
  return codec;
}

/// Converts frames to RGBA.
class RgbaFrame {
 public:
  const AVFrame& of(const AVFrame& frame) {
    const auto format = static_cast<AVPixelFormat>(frame.format);
    const Converter converter(made(sws_getContext(
        frame.width, frame.height, format, frame.width, frame.height, AV_PIX_FMT_RGBA,
        SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr, nullptr, nullptr)));
    // JPEG and WebP hold BT.601; JPEG in full range, which its pixel format says.
    const int* bt601 = sws_getCoefficients(SWS_CS_ITU601);
    const bool is_full = frame.color_range == AVCOL_RANGE_JPEG;
    sws_setColorspaceDetails(converter.get(), bt601, is_full ? 1 : 0, bt601, 1, 0, 1 << 16,
                             1 << 16);
    if (!frame_ || frame_->width != frame.width || frame_->height != frame.height)
      frame_ = new_frame(AV_PIX_FMT_RGBA, frame.width, frame.height);
    checked(sws_scale(converter.get(), frame.data, frame.linesize, 0, frame.height, frame_->data,
                      frame_->linesize),
            "conversion");
    return *frame_;
  }

 private:
  Frame frame_;
};

using Take = std::function<void(const DecodedFrame&)>;

/// FNV-1a of an ICC profile, without the date when it was made and the id that a program computes.
std::uint64_t profile_digest(std::span<const std::uint8_t> profile) {
  constexpr std::size_t kDate = 24, kDateEnd = 36, kId = 84, kIdEnd = 100;
  if (profile.empty()) return 0;
  std::uint64_t digest = 0xCBF29CE484222325U;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if ((i >= kDate && i < kDateEnd) || (i >= kId && i < kIdEnd)) continue;
    digest = (digest ^ profile[i]) * 0x100000001B3U;
  }
  return digest >> 1;  // Positive as a signed number.
}

std::uint64_t profile_of(const AVFrame& frame) {
  const AVFrameSideData* data = av_frame_get_side_data(&frame, AV_FRAME_DATA_ICC_PROFILE);
  return data == nullptr ? 0 : profile_digest({data->data, data->size});
}

/// Gives a codec its packets, and hands on the frames that it makes of them.
class FrameSource {
 public:
  FrameSource(Codec codec, AVRational time_base, const Take& take)
      : codec_(std::move(codec)),
        time_base_(time_base),
        frame_(made(av_frame_alloc())),
        take_(take) {}

  /// @param packet  Null: there are no more.
  void send(const AVPacket* packet) {
    if (packet != nullptr && packet->duration > 0) duration_ = packet->duration;
    decoded(avcodec_send_packet(codec_.get(), packet));
    while (true) {
      const int answer = avcodec_receive_frame(codec_.get(), frame_.get());
      if (answer == AVERROR(EAGAIN) || answer == AVERROR_EOF) return;
      decoded(answer);
      if (frame_->decode_error_flags != 0 || (frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0)
        throw std::runtime_error("it is damaged");
      ++frames_;
      const AVFrame& rgba = rgba_.of(*frame_);
      take_({.width = frame_->width,
             .height = frame_->height,
             .duration_ms = static_cast<int>(
                 std::min<std::int64_t>(av_rescale_q(duration_, time_base_, {1, 1000}), 1 << 30)),
             .profile = profile_of(*frame_),
             .rgba = rgba.data[0],
             .stride = rgba.linesize[0]});
    }
  }

  int frames() const { return frames_; }

 private:
  Codec codec_;
  AVRational time_base_;
  Frame frame_;
  const Take& take_;
  RgbaFrame rgba_;
  std::int64_t duration_ = 0;
  int frames_ = 0;
};

void decode_still(const std::string& bytes, const Traits& traits, const Take& take) {
  const Packet packet(made(av_packet_alloc()));
  checked(av_new_packet(packet.get(), static_cast<int>(bytes.size())), "packet");
  std::memcpy(packet->data, bytes.data(), bytes.size());
  FrameSource source(opened_codec(traits, nullptr), {1, 1000}, take);
  source.send(packet.get());
  source.send(nullptr);
  if (source.frames() == 0) throw std::runtime_error("it holds no image");
}

// Of a TIFF, what says nothing of its pixels as FFmpeg decodes them: texts, the unit of the
// resolution, which kind of alpha there is, EXIF and XMP data [TIFF 6.0; EXIF 2.3; XMP, part 3].
// FFmpeg, asked to refuse what is damaged, refuses tags that it does not know as well: the TIFFs of
// matplotlib, Pillow and R would be unreadable. Sorted.
constexpr std::array<std::size_t, 36> kMetadata = {
    263, 264, 265,   269,   270,   271,   272,   280,   281,   285,   286,   287,
    288, 289, 296,   297,   305,   306,   315,   316,   318,   319,   336,   337,
    338, 700, 33432, 33723, 34377, 34665, 34853, 37510, 37724, 42112, 42113, 50341};

// Of which the value 1 is the usual one: orientation, and format of the samples.
constexpr std::array<std::size_t, 2> kUsuallyOne = {274, 339};

constexpr std::size_t kHeaderBytes = 8, kCountBytes = 2, kEntryBytes = 12, kNextBytes = 4;

/// A TIFF file's numbers, in its order of bytes.
class Numbers {
 public:
  explicit Numbers(std::string_view bytes) : bytes_(bytes), is_big_(bytes.starts_with("MM")) {}

  /// @pre The bytes are there.
  std::size_t at(std::size_t position, std::size_t count) const {
    std::size_t number = 0;
    for (std::size_t i = 0; i < count; ++i)
      number = number << 8 | static_cast<unsigned char>(bytes_[position + index(i, count)]);
    return number;
  }
  static void set(std::string& bytes, std::size_t position, std::size_t count, std::size_t number) {
    const Numbers order(bytes);
    for (std::size_t i = 0; i < count; ++i)
      bytes[position + order.index(i, count)] =
          static_cast<char>(number >> (8 * (count - 1 - i)) & 0xFF);
  }

  /// Where the entries of a directory end; empty if it is not whole.
  std::optional<std::size_t> end_of(std::size_t directory) const {
    if (directory + kCountBytes > bytes_.size()) return std::nullopt;
    const std::size_t end = directory + kCountBytes + at(directory, kCountBytes) * kEntryBytes;
    return end + kNextBytes > bytes_.size() ? std::nullopt : std::optional(end);
  }

  bool is_metadata(std::size_t entry) const {
    const std::size_t tag = at(entry, 2);
    if (std::ranges::binary_search(kMetadata, tag)) return true;
    return std::ranges::find(kUsuallyOne, tag) != kUsuallyOne.end() && are_all_one(entry);
  }

  bool is_smaller_version(std::size_t directory, std::size_t end) const {
    constexpr std::size_t kNewSubfileType = 254;
    for (std::size_t entry = directory + kCountBytes; entry < end; entry += kEntryBytes)
      if (at(entry, 2) == kNewSubfileType) return (at(entry + 8, 4) & 1) != 0;
    return false;
  }

 private:
  std::size_t index(std::size_t i, std::size_t count) const { return is_big_ ? i : count - 1 - i; }

  /// Whether the values of an entry are of two bytes, and all 1.
  bool are_all_one(std::size_t entry) const {
    constexpr std::size_t kShort = 3, kMost = 16;
    const std::size_t count = at(entry + 4, 4);
    if (at(entry + 2, 2) != kShort || count == 0 || count > kMost) return false;
    const std::size_t values = count <= 2 ? entry + 8 : at(entry + 8, 4);
    if (values + 2 * count > bytes_.size()) return false;
    for (std::size_t i = 0; i < count; ++i)
      if (at(values + 2 * i, 2) != 1) return false;
    return true;
  }

  std::string_view bytes_;
  bool is_big_;
};

/// Where the directory of each page of a TIFF begins. Pages that are smaller versions of others are
/// left out; the last may be damaged or beyond the file, which the codec reports.
std::vector<std::size_t> tiff_pages(std::string_view tiff) {
  constexpr std::size_t kMost = 10'000;
  if (tiff.size() < kHeaderBytes) throw std::runtime_error("it is damaged");
  const Numbers numbers(tiff);
  std::vector<std::size_t> pages;
  std::set<std::size_t> seen;
  for (std::size_t directory = numbers.at(4, 4); directory != 0;) {
    if (!seen.insert(directory).second) throw std::runtime_error("it is damaged");
    if (seen.size() > kMost) throw std::runtime_error("it has more than 10,000 pages");
    const std::optional<std::size_t> end = numbers.end_of(directory);
    if (!end || pages.empty() || !numbers.is_smaller_version(directory, *end))
      pages.push_back(directory);
    if (!end) break;
    directory = numbers.at(*end, kNextBytes);
  }
  if (pages.empty()) throw std::runtime_error("it holds no image");
  return pages;
}

/// Makes a page the first of the file, and removes from its directory what is metadata.
/// @param directory  Of tiff_pages().
void make_first(std::string& tiff, std::size_t directory) {
  Numbers::set(tiff, 4, 4, directory);
  const Numbers numbers(tiff);
  const std::optional<std::size_t> end = numbers.end_of(directory);
  if (!end) return;
  const std::size_t first = directory + kCountBytes;
  std::size_t to = first;
  for (std::size_t at = first; at < *end; at += kEntryBytes) {
    if (numbers.is_metadata(at)) continue;
    std::copy_n(tiff.data() + at, kEntryBytes, tiff.data() + to);
    to += kEntryBytes;
  }
  std::copy_n(tiff.data() + *end, kNextBytes, tiff.data() + to);
  Numbers::set(tiff, directory, kCountBytes, (to - first) / kEntryBytes);
}

/// FFmpeg reads the first page of a TIFF.
void decode_pages(std::string bytes, const Traits& traits, const Take& take) {
  for (const std::size_t page : tiff_pages(bytes)) {
    make_first(bytes, page);
    decode_still(bytes, traits, take);
  }
}

int read_from_memory(void* opaque, std::uint8_t* to, int size) {
  auto& input = *static_cast<MemoryFile*>(opaque);
  const std::size_t count = std::min(static_cast<std::size_t>(size), input.bytes.size() - input.at);
  if (count == 0) return AVERROR_EOF;
  std::copy_n(input.bytes.data() + input.at, count, to);
  input.at += count;
  return static_cast<int>(count);
}

struct CloseInput {
  void operator()(AVFormatContext* format) const {
    AVIOContext* io = format->pb;
    avformat_close_input(&format);
    if (io != nullptr) av_free(io->buffer);
    avio_context_free(&io);
  }
};
using Input = std::unique_ptr<AVFormatContext, CloseInput>;

Input opened_input(MemoryFile& memory, const char* demuxer) {
  constexpr int kBlock = 1 << 16;
  Input input(made(avformat_alloc_context()));
  auto* block = static_cast<std::uint8_t*>(made(av_malloc(kBlock)));
  input->pb =
      avio_alloc_context(block, kBlock, 0, &memory, read_from_memory, nullptr, seek_in_memory);
  if (input->pb == nullptr) av_free(block);
  made(input->pb);
  AVDictionary* options = nullptr;
  av_dict_set(&options, "min_delay", "0", 0);  // Of GIF: times as they stand in the file.
  AVFormatContext* format = input.get();
  AVIOContext* io = format->pb;
  const int answer = avformat_open_input(&format, nullptr, av_find_input_format(demuxer), &options);
  av_dict_free(&options);
  if (answer < 0) {  // It freed the context, but not what it reads from.
    static_cast<void>(input.release());
    av_free(io->buffer);
    avio_context_free(&io);
    decoded(answer);
  }
  return input;
}

void decode_animation(std::string bytes, const Traits& traits, const Take& take) {
  MemoryFile memory{std::move(bytes)};
  const Input input = opened_input(memory, traits.demuxer);
  if (input->nb_streams == 0) throw std::runtime_error("it holds no image");
  const AVStream& stream = *input->streams[0];
  FrameSource source(opened_codec(traits, stream.codecpar), stream.time_base, take);
  const Packet packet(made(av_packet_alloc()));
  while (true) {
    const int answer = av_read_frame(input.get(), packet.get());
    if (answer == AVERROR_EOF) break;
    decoded(answer);
    source.send(packet.get());
    av_packet_unref(packet.get());
  }
  source.send(nullptr);
  if (source.frames() == 0) throw std::runtime_error("it holds no image");
}

struct DeleteWebp {
  void operator()(WebPDemuxer* parts) const { WebPDemuxDelete(parts); }
  void operator()(WebPAnimDecoder* decoder) const { WebPAnimDecoderDelete(decoder); }
};

/// Whether the flag of an animation is set in the extended header, which stands first.
bool is_animated_webp(std::string_view bytes) {
  constexpr std::size_t kFlags = 20;
  constexpr unsigned kAnimation = 2;
  return bytes.size() > kFlags && bytes.substr(12, 4) == "VP8X" &&
         (static_cast<unsigned char>(bytes[kFlags]) & kAnimation) != 0;
}

/// By libwebp, as FFmpeg reads no animated WebP.
void decode_animated_webp(const std::string& bytes, const Take& take) {
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  const std::unique_ptr<WebPDemuxer, DeleteWebp> parts(WebPDemux(&data));
  if (!parts) throw std::runtime_error("it is damaged");
  const auto width = static_cast<int>(WebPDemuxGetI(parts.get(), WEBP_FF_CANVAS_WIDTH));
  const auto height = static_cast<int>(WebPDemuxGetI(parts.get(), WEBP_FF_CANVAS_HEIGHT));
  // The decoder takes two frames from its first moment on.
  if (const std::string problem = decoded_size_problem(width, height); !problem.empty())
    throw std::runtime_error(problem);
  const std::unique_ptr<WebPAnimDecoder, DeleteWebp> decoder(WebPAnimDecoderNew(&data, nullptr));
  WebPAnimInfo facts{};
  if (!decoder || WebPAnimDecoderGetInfo(decoder.get(), &facts) == 0)
    throw std::runtime_error("it is damaged");
  WebPChunkIterator chunk{};
  const std::uint64_t profile = WebPDemuxGetChunk(parts.get(), "ICCP", 1, &chunk) == 0
                                    ? 0
                                    : profile_digest({chunk.chunk.bytes, chunk.chunk.size});
  WebPDemuxReleaseChunkIterator(&chunk);
  int before_ms = 0, frames = 0;
  while (WebPAnimDecoderHasMoreFrames(decoder.get()) != 0) {
    std::uint8_t* rgba = nullptr;
    int end_ms = 0;
    if (WebPAnimDecoderGetNext(decoder.get(), &rgba, &end_ms) == 0) break;
    take({width, height, end_ms - before_ms, profile, rgba, std::ptrdiff_t{4} * width});
    before_ms = end_ms;
    ++frames;
  }
  if (frames != static_cast<int>(facts.frame_count)) throw std::runtime_error("it is damaged");
}

}  // namespace

void decode_image(std::string bytes, std::string_view format, const Take& take) {
  av_log_set_level(AV_LOG_QUIET);
  const Traits& traits = traits_of(format);
  if (format == "webp" && is_animated_webp(bytes))
    decode_animated_webp(bytes, take);
  else if (format == "tiff")
    decode_pages(std::move(bytes), traits, take);
  else if (traits.demuxer == nullptr)
    decode_still(bytes, traits, take);
  else
    decode_animation(std::move(bytes), traits, take);
}

}  // namespace mapproof
