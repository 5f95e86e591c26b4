#include <array>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "core/base/files/files.hpp"
#include "render/image/png.hpp"
#include "reports/diff/images/image_diff.hpp"
#include "tests/reports/diff/mutations.hpp"

namespace mapproof::test {
namespace {

ImageState state_of(const PixelDiff& found) {
  if (found.changed > 0) return ImageState::kDifferent;
  return found.differing > 0 ? ImageState::kWithinTolerance : ImageState::kIdentical;
}

/// Rows: expected verdicts; columns: actual verdicts.
struct Confusion {
  std::array<std::array<int, 3>, 3> counts{};

  void print() const {
    fmt::print("{:>22}{:>20}{:>20}{:>20}\n", "must be, is called", name(ImageState::kIdentical),
               name(ImageState::kWithinTolerance), name(ImageState::kDifferent));
    for (int must = 0; must < 3; ++must)
      fmt::print("{:>22}{:>20}{:>20}{:>20}\n", name(static_cast<ImageState>(must)), counts[must][0],
                 counts[must][1], counts[must][2]);
  }
};

TEST(ImageMutations, NoneIsMissedAndNoneFalselyAlarms) {
  std::vector<Mutation> all;
  for (const auto& [image, drawing] : mutable_drawings())
    for (const auto& mutate : {mutations_of, subtle_mutations_of, moved_mutations_of})
      std::ranges::move(mutate(drawing, image), std::back_inserter(all));
  std::vector<PixelDiff> found(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    found[i] = pixel_diff(all[i].baseline(), all[i].current()).pixels;
  });
  Confusion confusion;
  int hidden = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    // Covered shapes cannot be seen.
    if (found[i].differing == 0 && all[i].expected != ImageState::kIdentical) {
      ++hidden;
      continue;
    }
    const ImageState said = state_of(found[i]);
    ++confusion.counts[static_cast<int>(all[i].expected)][static_cast<int>(said)];
    EXPECT_EQ(name(said), name(all[i].expected))
        << all[i].image << ": " << all[i].name << "; " << found[i].differing << " differ, "
        << found[i].changed << " changed";
  }
  confusion.print();
  EXPECT_GT(all.size(), 800u);
  EXPECT_LT(hidden, static_cast<int>(all.size() / 20));
}

}  // namespace
}  // namespace mapproof::test
