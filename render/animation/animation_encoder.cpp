#include "render/animation/animation_encoder.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

extern "C" {
#include <libavfilter/avfilter.h>
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include "render/animation/ffmpeg.hpp"

namespace mapproof {
namespace {

constexpr int kMillisecondsASecond = 1000;

struct FreeFormat {
  void operator()(AVFormatContext* format) const {
    if (format->pb != nullptr) av_free(format->pb->buffer);
    avio_context_free(&format->pb);
    avformat_free_context(format);
  }
};
struct FreeGraph {
  void operator()(AVFilterGraph* graph) const { avfilter_graph_free(&graph); }
};

/// FFmpeg 7 and newer hand over const bytes.
template <typename Byte>
int write_to_memory(void* opaque, Byte* data, int size) {
  auto& file = *static_cast<MemoryFile*>(opaque);
  const auto count = static_cast<std::size_t>(size);
  try {
    if (file.bytes.size() < file.at + count) file.bytes.resize(file.at + count);
  } catch (const std::bad_alloc&) {
    return AVERROR(ENOMEM);
  }
  std::memcpy(file.bytes.data() + file.at, data, count);
  file.at += count;
  return size;
}

/// FFmpeg's own dynamic buffer appends padding at the current offset, which is inside the file
/// here: the number of frames is written into the header last.
AVIOContext* opened(MemoryFile& file) {
  constexpr int kBlock = 1 << 16;
  auto* block = static_cast<std::uint8_t*>(made(av_malloc(kBlock)));
  AVIOContext* context =
      avio_alloc_context(block, kBlock, 1, &file, nullptr, write_to_memory, seek_in_memory);
  if (context == nullptr) av_free(block);
  return made(context);
}

/// What differs between the formats.
struct FormatTraits {
  const char* muxer;
  AVPixelFormat pixels;
  int ticks_a_second;
  bool even;         ///< Both sides are even.
  const char* loop;  ///< Option of the muxer for endless play; null: it has none.
};

FormatTraits traits_of(const std::string& format) {
  if (format == "apng") return {"apng", AV_PIX_FMT_RGB24, kMillisecondsASecond, false, "plays"};
  if (format == "mp4") return {"mp4", AV_PIX_FMT_YUV420P, kMillisecondsASecond, true, nullptr};
  if (format == "gif") return {"gif", AV_PIX_FMT_PAL8, 100, false, "loop"};
  throw std::runtime_error("no such format");
}

const AVCodec* encoder_of(const std::string& format) {
  const AVCodec* kind = nullptr;
  if (format == "apng") kind = avcodec_find_encoder(AV_CODEC_ID_APNG);
  if (format == "gif") kind = avcodec_find_encoder(AV_CODEC_ID_GIF);
  if (format == "mp4") {
    kind = avcodec_find_encoder_by_name("libx264");
    if (kind == nullptr) kind = avcodec_find_encoder(AV_CODEC_ID_MPEG4);
  }
  if (kind == nullptr) throw std::runtime_error("FFmpeg has no encoder of " + format);
  return kind;
}

/// From sRGB to the video range of BT.709.
SwsContext* video_converter(int width, int height) {
  SwsContext* converter =
      made(sws_getContext(width, height, AV_PIX_FMT_RGB24, width, height, AV_PIX_FMT_YUV420P,
                          SWS_BICUBIC | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
  const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
  sws_setColorspaceDetails(converter, bt709, 1, bt709, 0, 0, 1 << 16, 1 << 16);
  return converter;
}

/// The graph of filters that chooses 256 colours for all frames and draws them in these.
struct PaletteGraph {
  std::unique_ptr<AVFilterGraph, FreeGraph> graph;
  AVFilterContext* source = nullptr;
  AVFilterContext* sink = nullptr;
};

PaletteGraph palette_graph(int width, int height, int ticks_a_second) {
  PaletteGraph palette;
  palette.graph.reset(made(avfilter_graph_alloc()));
  AVFilterGraph* graph = palette.graph.get();
  graph->nb_threads = 1;
  std::array<char, 200> size{};
  std::snprintf(size.data(), size.size(), "video_size=%dx%d:pix_fmt=%d:time_base=1/%d", width,
                height, static_cast<int>(AV_PIX_FMT_RGB24), ticks_a_second);
  checked(avfilter_graph_create_filter(&palette.source, avfilter_get_by_name("buffer"), "in",
                                       size.data(), nullptr, graph),
          "palette");
  checked(avfilter_graph_create_filter(&palette.sink, avfilter_get_by_name("buffersink"), "out",
                                       nullptr, nullptr, graph),
          "palette");
  AVFilterInOut* outputs = made(avfilter_inout_alloc());
  AVFilterInOut* inputs = avfilter_inout_alloc();
  if (inputs == nullptr) avfilter_inout_free(&outputs);
  made(inputs);
  outputs->name = av_strdup("in");
  outputs->filter_ctx = palette.source;
  inputs->name = av_strdup("out");
  inputs->filter_ctx = palette.sink;
  const int answer =
      avfilter_graph_parse_ptr(graph,
                               "split[one][two];[one]palettegen=reserve_transparent=0[colours];"
                               "[two][colours]paletteuse=dither=sierra2_4a",
                               &inputs, &outputs, nullptr);
  avfilter_inout_free(&inputs);
  avfilter_inout_free(&outputs);
  checked(answer, "palette");
  checked(avfilter_graph_config(graph, nullptr), "palette");
  return palette;
}

}  // namespace

struct AnimationEncoder::State {
  MemoryFile file;
  FormatTraits traits{};
  Codec codec;
  std::unique_ptr<AVFormatContext, FreeFormat> format;
  Frame frame;  ///< RGB.
  Packet packet;
  Converter converter;        ///< Of MP4.
  Frame converted;            ///< Likewise.
  PaletteGraph palette;       ///< Of GIF.
  int width = 0, height = 0;  ///< Of the input.
  std::int64_t ticks = 0;     ///< How long each frame is shown.
  std::int64_t next = 0;      ///< Frames that were added.
};

namespace {

void set_up_codec(const AnimationInput& input, const FormatTraits& traits, AVCodecContext& codec) {
  codec.width = input.width + (traits.even ? input.width % 2 : 0);
  codec.height = input.height + (traits.even ? input.height % 2 : 0);
  codec.pix_fmt = traits.pixels;
  codec.time_base = {1, traits.ticks_a_second};
  codec.thread_count = 1;
  codec.flags |= AV_CODEC_FLAG_BITEXACT;
  if (input.format == "apng") {
    codec.compression_level = 9;
    checked(av_opt_set(codec.priv_data, "pred", "mixed", 0), "prediction");
  }
  if (input.format != "mp4") return;
  codec.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  codec.framerate = {kMillisecondsASecond, input.frame_ms};
  codec.color_range = AVCOL_RANGE_MPEG;
  codec.colorspace = AVCOL_SPC_BT709;
  codec.color_primaries = AVCOL_PRI_BT709;
  codec.color_trc = AVCOL_TRC_BT709;
  if (av_opt_set(codec.priv_data, "crf", "18", 0) < 0) {  // MPEG-4 has none.
    codec.flags |= AV_CODEC_FLAG_QSCALE;
    codec.global_quality = 2 * FF_QP2LAMBDA;
  }
}

}  // namespace

AnimationEncoder::AnimationEncoder(const AnimationInput& input)
    : state_(std::make_unique<State>()) {
  av_log_set_level(AV_LOG_ERROR);
  State& state = *state_;
  state.traits = traits_of(input.format);
  const int a_second = state.traits.ticks_a_second;
  state.ticks =
      std::max<std::int64_t>(1, std::int64_t{input.frame_ms} * a_second / kMillisecondsASecond);
  state.width = input.width;
  state.height = input.height;
  const AVCodec* kind = encoder_of(input.format);
  state.codec.reset(made(avcodec_alloc_context3(kind)));
  AVCodecContext& codec = *state.codec;
  set_up_codec(input, state.traits, codec);
  checked(avcodec_open2(&codec, kind, nullptr), "encoder");

  AVFormatContext* format = nullptr;
  checked(avformat_alloc_output_context2(&format, nullptr, state.traits.muxer, nullptr),
          state.traits.muxer);
  state.format.reset(format);
  format->flags |= AVFMT_FLAG_BITEXACT;
  AVStream* stream = made(avformat_new_stream(format, nullptr));
  stream->time_base = codec.time_base;
  checked(avcodec_parameters_from_context(stream->codecpar, &codec), "stream");
  if (state.traits.loop != nullptr)
    checked(av_opt_set_int(format->priv_data, state.traits.loop, 0, 0), "endless play");
  format->pb = opened(state.file);
  checked(avformat_write_header(format, nullptr), "header");

  state.frame = new_frame(AV_PIX_FMT_RGB24, codec.width, codec.height);
  state.packet.reset(made(av_packet_alloc()));
  if (input.format == "mp4") {
    state.converter.reset(video_converter(codec.width, codec.height));
    state.converted = new_frame(AV_PIX_FMT_YUV420P, codec.width, codec.height);
  }
  if (input.format == "gif") state.palette = palette_graph(codec.width, codec.height, a_second);
}

AnimationEncoder::~AnimationEncoder() = default;

void AnimationEncoder::add(const std::vector<std::uint32_t>& pixels) {
  State& state = *state_;
  AVFrame& frame = *state.frame;
  checked(av_frame_make_writable(&frame), "frame");
  for (int y = 0; y < frame.height; ++y) {
    std::uint8_t* to = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
    const std::size_t row = static_cast<std::size_t>(std::min(y, state.height - 1)) *
                            static_cast<std::size_t>(state.width);
    for (int x = 0; x < frame.width; ++x) {
      const std::uint32_t pixel =
          pixels.at(row + static_cast<std::size_t>(std::min(x, state.width - 1)));
      for (const int shift : {16, 8, 0}) *to++ = static_cast<std::uint8_t>(pixel >> shift);
    }
  }
  frame.pts = state.next++ * state.ticks;
  if (state.palette.graph) {
    checked(av_buffersrc_add_frame_flags(state.palette.source, &frame, AV_BUFFERSRC_FLAG_KEEP_REF),
            "palette");
    return;
  }
  if (!state.converter) return encode(&frame);
  AVFrame& converted = *state.converted;
  checked(av_frame_make_writable(&converted), "frame");
  checked(sws_scale(state.converter.get(), frame.data, frame.linesize, 0, frame.height,
                    converted.data, converted.linesize),
          "conversion");
  converted.pts = frame.pts;
  encode(&converted);
}

void AnimationEncoder::encode(AVFrame* frame) {
  State& state = *state_;
  checked(avcodec_send_frame(state.codec.get(), frame), "frame");
  while (true) {
    AVPacket* packet = state.packet.get();
    const int answer = avcodec_receive_packet(state.codec.get(), packet);
    if (answer == AVERROR(EAGAIN) || answer == AVERROR_EOF) return;
    checked(answer, "packet");
    packet->stream_index = 0;
    packet->duration = state.ticks;
    av_packet_rescale_ts(packet, state.codec->time_base, state.format->streams[0]->time_base);
    checked(av_write_frame(state.format.get(), packet), "packet");
    av_packet_unref(packet);
  }
}

std::string AnimationEncoder::finish() {
  State& state = *state_;
  if (state.palette.graph) {
    checked(av_buffersrc_add_frame_flags(state.palette.source, nullptr, 0), "palette");
    while (true) {
      const Frame shown(made(av_frame_alloc()));
      const int answer = av_buffersink_get_frame(state.palette.sink, shown.get());
      if (answer == AVERROR_EOF) break;
      checked(answer, "palette");
      encode(shown.get());
    }
  }
  encode(nullptr);
  checked(av_write_trailer(state.format.get()), "end");
  avio_flush(state.format->pb);
  checked(state.format->pb->error, "end");
  return std::move(state.file.bytes);
}

}  // namespace mapproof
