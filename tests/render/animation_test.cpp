#include "render/animation/animation.hpp"

#include <algorithm>
#include <filesystem>
#include <new>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "render/output/write_scene.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/faults.hpp"
#include "tests/support/images/apng_reader.hpp"
#include "tests/support/samples/sample_scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

const std::filesystem::path kProgram = MAPPROOF_ANIMATION_PROGRAM;

/// Noise on which a square moves.
std::vector<Image> frames_of(int count, int width, int height) {
  Random random(4);
  Image back{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    back.pixels.push_back(static_cast<std::uint32_t>(random.next() & 0xFFFFFF));
  std::vector<Image> frames(static_cast<std::size_t>(count), back);
  for (int i = 0; i < count; ++i)
    for (int y = 2; y < 7; ++y)
      std::fill_n(frames[static_cast<std::size_t>(i)].row(y) + 3 * i, 5, 0xD55E00U);
  return frames;
}

void expect_same(const ApngFrame& got, const Image& frame) {
  ASSERT_EQ(got.image.width, frame.width);
  ASSERT_EQ(got.image.height, frame.height);
  EXPECT_TRUE(got.image.pixels == frame.pixels);
}

TEST(Animation, GivesBackEachFrameToThePixelForItsTimeAndBeginsAgain) {
  const std::vector<Image> frames = frames_of(5, 41, 23);
  const Apng apng = read_apng(encode_animation(frames, {.frame_ms = 250, .texts = {}}, kProgram));
  EXPECT_EQ(apng.plays, 0U);
  ASSERT_EQ(apng.frames.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    expect_same(apng.frames[i], frames[i]);
    EXPECT_NEAR(apng.frames[i].seconds, 0.25, 1e-9) << i;
  }
}

TEST(Animation, OfFramesThatAreAlikeHasThemAll) {
  const std::vector<Image> frames(3, frames_of(1, 9, 8)[0]);
  const Apng apng = read_apng(encode_animation(frames, {}, kProgram));
  ASSERT_EQ(apng.frames.size(), 3U);
  for (const ApngFrame& frame : apng.frames) expect_same(frame, frames[0]);
}

TEST(Animation, IsTheSameBytesEachTimeAndCarriesItsTexts) {
  const std::vector<Image> frames = frames_of(4, 33, 17);
  const AnimationOptions options{.frame_ms = 500, .texts = {{"Title", "λ moves"}}};
  const std::string once = encode_animation(frames, options, kProgram);
  EXPECT_EQ(once, encode_animation(frames, options, kProgram));
  EXPECT_NE(once.find("λ moves"), std::string::npos);
  EXPECT_EQ(read_apng(once).frames.size(), 4U);
}

TEST(Animation, AsGifHasEveryFrameForItsTimeAndRepeats) {
  const std::vector<Image> frames = frames_of(4, 33, 17);
  const AnimationOptions options{.format = AnimationFormat::kGif, .frame_ms = 500};
  const std::string gif = encode_animation(frames, options, kProgram);
  EXPECT_TRUE(gif.starts_with("GIF89a"));
  EXPECT_EQ(gif.substr(6, 4), std::string("\x21\0\x11\0", 4)) << "33 x 17 pixels";
  EXPECT_NE(gif.find("NETSCAPE2.0"), std::string::npos);
  std::size_t shown = 0;  // Blocks that say how long a frame is shown: 50 hundredths.
  for (std::size_t at = 0; (at = gif.find("\x21\xF9\x04", at)) != std::string::npos; ++at)
    shown += gif.substr(at + 4, 2) == std::string("\x32\0", 2) ? 1 : 0;
  EXPECT_EQ(shown, 4U);
  EXPECT_EQ(gif, encode_animation(frames, options, kProgram));
}

TEST(Animation, AsMp4HasEvenSidesAndIsTheSameBytesEachTime) {
  const std::vector<Image> frames = frames_of(4, 65, 33);
  const AnimationOptions options{.format = AnimationFormat::kMp4, .frame_ms = 500};
  const std::string mp4 = encode_animation(frames, options, kProgram);
  EXPECT_EQ(mp4.substr(4, 4), "ftyp");
  // The header of the track ends with its width and height in 16.16: 66 x 34.
  const std::size_t track = mp4.find("tkhd");
  ASSERT_NE(track, std::string::npos);
  EXPECT_EQ(mp4.substr(track + 80, 8), std::string("\0\x42\0\0\0\x22\0\0", 8));
  EXPECT_EQ(mp4, encode_animation(frames, options, kProgram));
}

TEST(Animation, RefusesFramesThatDiffer) {
  const auto refused = [](std::vector<Image> frames, int frame_ms) {
    EXPECT_THROW(encode_animation(frames, {.frame_ms = frame_ms, .texts = {}}, kProgram),
                 InvalidInput);
  };
  refused({}, 100);
  refused(frames_of(1, 20, 20), 100);
  refused(frames_of(2, 20, 20), 0);
  refused(frames_of(2, 20, 20), 1'000'000);
  std::vector<Image> frames = frames_of(2, 20, 20);
  frames[1].height = 19;
  refused(frames, 100);
  frames[1] = Image{0, 0, {}};
  refused({frames[1], frames[1]}, 100);
}

TEST(Animation, ThatFindsNoMemoryInItsProgramSaysSo) {
  const std::string name = kProgram.filename().string();
  const std::vector<Image> frames = frames_of(3, 300, 200);
  const std::string whole = encode_animation(frames, {}, kProgram);
  long calls = 1, reported = 0;
  for (long call = 0; call <= calls; ++call) {
    const Faults faults(call == 0 ? "" : at_call("alloc", call), name);
    try {
      EXPECT_TRUE(encode_animation(frames, {}, kProgram) == whole) << call;
    } catch (const std::bad_alloc&) {
      ++reported;
    }
    if (call == 0) calls = faults.calls("alloc");
  }
  EXPECT_GT(calls, 5);
  EXPECT_GT(reported, calls / 2);
}

TEST(Animation, WithoutItsProgramIsOneLine) {
  const auto said = [](const std::filesystem::path& program) -> std::string {
    try {
      encode_animation(frames_of(2, 9, 9), {}, program);
    } catch (const AnimationError& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_EQ(
      said("/nowhere/encoder"),
      "the animation cannot be made: encoder: /nowhere/encoder is not a program: No such file "
      "or directory");
  EXPECT_EQ(said("/bin/false"), "the animation cannot be made: false: it ended with exit code 1");
  EXPECT_EQ(said("/bin/true"), "the animation cannot be made: true: it gave no PNG");
}

TEST(Animation, OfAMapThatFormsHasAFrameAStep) {
  const TemporaryFolder folder;
  SceneClient client(MAPPROOF_SCENES_PROGRAM);
  const Environment ours{{"MAPPROOF_ANIMATION", kProgram.c_str()}};
  Film film = sample_film();
  film.frames.resize(3);
  write_animation(film, paper_theme(3.25), folder.path(), client);
  const Apng apng = read_apng(read_file(folder / (film.id + ".apng")));
  ASSERT_EQ(apng.frames.size(), 3U);
  EXPECT_FALSE(apng.frames[0].image.pixels == apng.frames[2].image.pixels);
  film.frames.clear();
  EXPECT_THROW(write_animation(film, report_theme(), folder.path(), client), InvalidInput);
}

}  // namespace
}  // namespace mapproof::test
