#include "reports/diff/images/tile_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace mapproof {
namespace {

constexpr int kFarthest = 3;  // Pixels: with slopes, the most that the margin of a patch allows.
constexpr double kFarthestRest = 0.75;  // Beyond whole pixels.
constexpr std::size_t kMostStyles = 6;

/// Slope of a smoothed plane in 1 of 255 per pixel, from five cells.
double slope(const Plane& plane, int i, int step, int scale) {
  return (8 * (plane[i + step] - plane[i - step]) - (plane[i + 2 * step] - plane[i - 2 * step])) /
         (12.0 * scale);
}

/// The same planes of both images, red first.
struct PlanePair {
  const std::array<Plane, 3>& before;
  const std::array<Plane, 3>& after;
  int scale;  ///< The value in the planes of a difference of 1 of 255.
};

/// @param noise, offset, around  As in movement_fit().
MovementFit fit_of(const PlanePair& planes, double noise, int offset, int around) {
  const auto& [before, after, scale] = planes;
  MovementFit fit;
  for (int y = -around; y < kTile + around; ++y)
    for (int x = -around; x < kTile + around; ++x) {
      const int i = cell_at(x, y), j = i - offset;
      for (int c = 0; c < 3; ++c) {
        const Plane &a = before[c], &b = after[c];
        const double d = static_cast<double>(b[i] - a[j]) / scale;
        if (std::abs(d) <= noise) continue;
        const double gx = (slope(a, j, 1, scale) + slope(b, i, 1, scale)) / 2.0;
        const double gy = (slope(a, j, kPatchSide, scale) + slope(b, i, kPatchSide, scale)) / 2.0;
        fit.gxx += gx * gx, fit.gxy += gx * gy, fit.gyy += gy * gy;
        fit.gxd += gx * d, fit.gyd += gy * d, fit.energy += d * d;
      }
    }
  return fit;
}

/// A window of a tile and its structural similarity.
struct WindowStructure {
  double structure = 1.0;
  int x = 0, y = 0, width = 0, height = 0;  ///< In the tile.
};

constexpr int kWindow = 8;
constexpr int kStride = 4;

/// 0 to 255 [BT.601].
int luma(const Patch& patch, int cell) {
  return (77 * patch.raw[0][cell] + 150 * patch.raw[1][cell] + 29 * patch.raw[2][cell]) >> 8;
}

double structure(const PatchPair& pair, const WindowStructure& window) {
  int sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (int y = window.y; y < window.y + window.height; ++y)
    for (int x = window.x; x < window.x + window.width; ++x) {
      const int a = luma(pair.before, cell_at(x, y)), b = luma(pair.after, cell_at(x, y));
      sum_a += a, sum_b += b;
      sum_aa += a * a, sum_bb += b * b, sum_ab += a * b;
    }
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255, kC2 = 0.03 * 255 * 0.03 * 255;
  const double n = window.width * window.height;
  const double mean_a = sum_a / n, mean_b = sum_b / n;
  const double var_a = sum_aa / n - mean_a * mean_a, var_b = sum_bb / n - mean_b * mean_b;
  const double covariance = sum_ab / n - mean_a * mean_b;
  return (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
         ((mean_a * mean_a + mean_b * mean_b + kC1) * (var_a + var_b + kC2));
}

/// Finds the window with the least structural similarity [wang2004] by luma, among windows of 8 x 8
/// pixels, one every 4 pixels. One number for the whole image would hide small damage.
/// @param width, height  Of the part of the tile inside the image.
WindowStructure least_window_structure(const PatchPair& pair, int width, int height) {
  WindowStructure least{1.0, 0, 0, std::min(kWindow, width), std::min(kWindow, height)};
  for (int y = 0; y < height; y += kStride)
    for (int x = 0; x < width; x += kStride) {
      WindowStructure window{1.0, x, y, std::min(kWindow, width - x),
                             std::min(kWindow, height - y)};
      window.structure = structure(pair, window);
      if (window.structure < least.structure) least = window;
    }
  return least;
}

/// How well different colours on the same shapes explain a tile's difference.
struct Recolouring {
  double share =
      0.0;  ///< The share of the sum of squares of the difference that an affine map explains.
  double off_line = 0.0;  ///< Of 255: the largest distance of a pixel from the line between the
                          ///< background and its colour.
  int pixels = 0;         ///< Pixels that differ beyond the noise, and their neighbours.
};

struct Pixel {
  Eigen::Vector3d before, difference;
};

Eigen::Vector3d colour_at(const Patch& patch, int cell) {
  return {double(patch.raw[0][cell]), double(patch.raw[1][cell]), double(patch.raw[2][cell])};
}

/// The pixels of the tile that differ beyond the noise, and their neighbours.
std::vector<Pixel> pixels_near_differences(const PatchPair& pair, double noise) {
  std::array<bool, kPatchCells> near{};
  const auto mark_around = [&near](int cell) {
    for (const int row : {cell - kPatchSide, cell, cell + kPatchSide})
      for (const int i : {row - 1, row, row + 1}) near[i] = true;
  };
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < kTile; ++x)
      if (const int cell = cell_at(x, y); pair.is_beyond(cell, noise)) mark_around(cell);
  std::vector<Pixel> pixels;
  for (int i = 0; i < kPatchCells; ++i)
    if (near[i]) {
      const Eigen::Vector3d before = colour_at(pair.before, i);
      pixels.push_back({before, colour_at(pair.after, i) - before});
    }
  return pixels;
}

/// Fits D = M (red, green, blue, 1) to the pixels that differ and their neighbours. The fit is
/// exact if up to four colours, mixed by anti-aliasing, were replaced by others. Anti-aliasing
/// alone changes how much of a colour a pixel has, and so keeps it on the line between the
/// background and that colour.
Recolouring find_recolouring(const PatchPair& pair, double noise) {
  const std::vector<Pixel> pixels = pixels_near_differences(pair, noise);
  Recolouring found;
  found.pixels = static_cast<int>(pixels.size());
  const auto row_of = [](const Pixel& pixel) {
    return Eigen::Vector4d(pixel.before.x(), pixel.before.y(), pixel.before.z(), 255.0);
  };
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 3> right = Eigen::Matrix<double, 4, 3>::Zero();
  Eigen::Vector3d paper = Eigen::Vector3d::Zero();
  double energy = 0.0, rest = 0.0;
  int still = 0;
  for (const Pixel& pixel : pixels) {
    const Eigen::Vector4d row = row_of(pixel);
    normal += row * row.transpose();
    right += row * pixel.difference.transpose();
    energy += pixel.difference.squaredNorm();
    if (pixel.difference.cwiseAbs().maxCoeff() <= noise) paper += pixel.before, ++still;
  }
  if (pixels.size() < 12 || still == 0 || energy == 0.0) return found;
  paper /= still;
  normal.diagonal().array() += 1e-6 * normal.trace();
  const Eigen::Matrix<double, 4, 3> map = normal.ldlt().solve(right);
  for (const Pixel& pixel : pixels) {
    const Eigen::Vector3d reported = map.transpose() * row_of(pixel);
    rest += (pixel.difference - reported).squaredNorm();
    const Eigen::Vector3d drawn = pixel.before - paper;
    const double length = drawn.norm();
    if (length >= 8.0)
      found.off_line = std::max(
          found.off_line, (reported - reported.dot(drawn) / (length * length) * drawn).norm());
  }
  found.share = 1.0 - rest / energy;
  return found;
}

// A pixel is lost if the other image lacks this share of the contrast around it.
constexpr double kLostTileShare = 0.8;

// Fewer pixels beyond noise do not determine a shape.
constexpr int kFewestShapePixels = 8;

// The number of standard deviations of noise that a mean may be off: an image has a million means.
constexpr double kDeviations = 6.0;

/// The distance of a cell's smoothed colour from the range of those around it in the other image.
int gap_at(const PatchPair& pair, int c, int i) {
  const Patch &a = pair.before, &b = pair.after;
  return std::max({b.smooth[c][i] - a.high[c][i], a.low[c][i] - b.smooth[c][i],
                   a.smooth[c][i] - b.high[c][i], b.low[c][i] - a.smooth[c][i], 0});
}

/// The range of smoothed colours within two cells of a cell, in the image where it is larger.
int contrast_at(const PatchPair& pair, int c, int i) {
  int contrast = 1;
  for (const Patch* patch : {&pair.before, &pair.after}) {
    const Plane &low = patch->low[c], &high = patch->high[c];
    int least = low[i], most = high[i];
    for (const int j :
         {i - kPatchSide - 1, i - kPatchSide + 1, i + kPatchSide - 1, i + kPatchSide + 1}) {
      least = std::min<int>(least, low[j]);
      most = std::max<int>(most, high[j]);
    }
    contrast = std::max(contrast, most - least);
  }
  return contrast;
}

bool is_lost(const PatchPair& pair, int i, double noise) {
  for (int c = 0; c < 3; ++c)
    if (const int gap = gap_at(pair, c, i);
        gap > 1.25 * noise * kSmoothScale && gap > kLostTileShare * contrast_at(pair, c, i))
      return true;
  return false;
}

/// Whether the smoothed colour changes by more than a fifth of its range around the cell, in the
/// image where that range is smaller.
bool is_bold(const PatchPair& pair, int i) {
  for (int c = 0; c < 3; ++c) {
    const Patch &a = pair.before, &b = pair.after;
    const int span = std::min(a.high[c][i] - a.low[c][i], b.high[c][i] - b.low[c][i]);
    if (5 * std::abs(b.smooth[c][i] - a.smooth[c][i]) > span + kSmoothScale) return true;
  }
  return false;
}

/// Counts the neighbours from which the cell's new colour may come, if everything moved by a pixel.
void count_copies(const PatchPair& pair, int i, double noise, std::array<int, 8>& copied) {
  for (std::size_t step = 0; step < kNeighbourSteps.size(); ++step) {
    const int j = i + kNeighbourSteps[step][1] * kPatchSide + kNeighbourSteps[step][0];
    int largest = 0;
    for (int c = 0; c < 3; ++c)
      largest = std::max(largest, std::abs(pair.after.raw[c][i] - pair.before.raw[c][j]));
    copied[step] += largest <= noise;
  }
}

/// The share of the difference that remains if the baseline is moved by whole pixels and then by a
/// fraction.
double left_by_whole(const PatchPair& pair, double noise, double right_px, double down_px) {
  const auto whole = [](double px) {
    return static_cast<int>(std::lround(std::clamp(px, -2.0, 2.0)));
  };
  const int right = whole(right_px), down = whole(down_px);
  if (right == 0 && down == 0) return 1.0;
  const double before = movement_fit(pair, noise, 0, 0).energy;
  const MovementFit after = movement_fit(pair, noise, down * kPatchSide + right, 0);
  const auto [x, y] = after.movement();
  return before > 0.0 ? after.left(x, y) / before : 1.0;
}

void find_displacement(const PatchPair& pair, const EvidenceBounds& bounds, TileEvidence& found) {
  const double noise = bounds.is_noisy ? bounds.noise : 0.25;
  found.fit = movement_fit(pair, noise, 0, kPatchMargin - 4);
  const double energy = found.fit.energy;
  if (energy == 0.0) return;
  const auto [right, down] = found.fit.movement();
  found.right_px = right, found.down_px = down;
  found.moved_share = 1.0 - found.fit.left(right, down) / energy;
  const double part =
      std::min(1.0, bounds.displacement_px / std::max(found.displacement_px(), 1e-9));
  found.left_share = found.fit.left(part * right, part * down) / energy;
  found.left_by_whole = left_by_whole(pair, noise, right, down);
  if (found.beyond_noise >= kFewestShapePixels) found.kept = kept_shape(pair, right, down);
}

/// Sums of the differences of flat pixels: those without an edge around them in either image.
struct FlatSums {
  std::array<std::array<int, 3>, 2 * kTile> sums{};  ///< Rows, then columns.
  std::array<int, 2 * kTile> counts{};

  void add(const PatchPair& pair, int x, int y) {
    ++counts[y], ++counts[kTile + x];
    const int i = cell_at(x, y);
    for (int c = 0; c < 3; ++c) {
      const int difference = pair.after.raw[c][i] - pair.before.raw[c][i];
      sums[y][c] += difference, sums[kTile + x][c] += difference;
    }
  }

  /// The change of the mean over `number` rows or columns from `first` beyond that explained by
  /// noise.
  double shift(int first, int number, const EvidenceBounds& bounds, bool is_noisy) const {
    int count = 0;
    std::array<int, 3> sum{};
    int thin_runs = 0;
    for (int run = first; run < first + number; ++run) {
      thin_runs += counts[run] < kTile / 2;
      count += counts[run];
      for (int c = 0; c < 3; ++c) sum[c] += sums[run][c];
    }
    // If only one or two rows are flat, they may be the anti-aliased edge of a pale shape.
    if (count < 2 * kTile || thin_runs > number - 3) return -1.0;
    const double deviation = is_noisy ? 0.6 * bounds.noise / std::sqrt(count) : 0.0;
    const int most = std::max({std::abs(sum[0]), std::abs(sum[1]), std::abs(sum[2])});
    return static_cast<double>(most) / count - bounds.mean_noise - kDeviations * deviation;
  }
};

FlatSums flat_sums(const PatchPair& pair, double noise, int width, int height) {
  const int flat = static_cast<int>(kSmoothScale * (1.0 + noise));
  FlatSums sums;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = cell_at(x, y);
      bool is_flat = true;
      for (int c = 0; c < 3; ++c)
        for (const Patch* patch : {&pair.before, &pair.after})
          is_flat = is_flat && patch->high[c][i] - patch->low[c][i] <= flat;
      if (is_flat) sums.add(pair, x, y);
    }
  return sums;
}

/// The largest shift of the tile or of three rows or columns: a pale line that anti-aliasing moves
/// by a pixel keeps its sum in them.
double flat_shift(const FlatSums& sums, const EvidenceBounds& bounds, bool is_noisy) {
  double shift = sums.shift(0, kTile, bounds, is_noisy);
  for (int run = 0; run + 3 <= kTile; ++run)
    for (const int first : {run, kTile + run})
      shift = std::max(shift, sums.shift(first, 3, bounds, is_noisy));
  return shift;
}

/// The mean shift, less the bound, of pixels that change as much as all their neighbours, as under
/// a transparent layer and not at edges; negative if there are too few.
double film_shift(const PatchPair& pair, const EvidenceBounds& bounds, int width, int height) {
  std::array<Plane, 3> difference, least, most;
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < kPatchCells; ++i)
      difference[c][i] = static_cast<std::int16_t>(pair.after.raw[c][i] - pair.before.raw[c][i]);
    neighbour_bounds(difference[c], least[c], most[c]);
  }
  int count = 0, sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = cell_at(x, y);
      bool is_even = true, is_one_way = false;
      int shift = 0;
      for (int c = 0; c < 3; ++c) {
        is_even = is_even && most[c][i] - least[c][i] <= bounds.noise;
        is_one_way = is_one_way || least[c][i] > 0 || most[c][i] < 0;
        shift = std::max(shift, std::abs(difference[c][i]));
      }
      if (is_even && is_one_way) ++count, sum += shift;
    }
  return count < kTile ? -1.0 : static_cast<double>(sum) / count - bounds.mean_noise;
}

/// The difference of two pixels, 0 to 1 [kotsarenko2010]: the distance in YIQ with perceptual
/// weights.
double colour_difference(const PatchPair& pair, int i) {
  std::array<double, 3> d;
  for (int c = 0; c < 3; ++c) d[c] = pair.after.raw[c][i] - pair.before.raw[c][i];
  const double y = 0.29889531 * d[0] + 0.58662247 * d[1] + 0.11448223 * d[2];
  const double in_phase = 0.59597799 * d[0] - 0.27417610 * d[1] - 0.32180189 * d[2];
  const double quadrature = 0.21147017 * d[0] - 0.52261711 * d[1] + 0.31114694 * d[2];
  constexpr double kBlackToWhite = 0.5053 * 255 * 255;
  return std::sqrt(std::min(
      1.0, (0.5053 * y * y + 0.299 * in_phase * in_phase + 0.1957 * quadrature * quadrature) /
               kBlackToWhite));
}

}  // namespace

void MovementFit::add(const MovementFit& other, double weight) {
  energy += weight * other.energy;
  gxx += weight * other.gxx, gxy += weight * other.gxy, gyy += weight * other.gyy;
  gxd += weight * other.gxd, gyd += weight * other.gyd;
}

std::array<double, 2> MovementFit::movement() const {
  const double ridge = 0.01 * (gxx + gyy) + 1e-9;
  const double xx = gxx + ridge, yy = gyy + ridge;
  const double determinant = xx * yy - gxy * gxy;
  return {-(yy * gxd - gxy * gyd) / determinant, -(xx * gyd - gxy * gxd) / determinant};
}

double MovementFit::left(double x, double y) const {
  const double left =
      energy + 2 * (x * gxd + y * gyd) + x * x * gxx + 2 * x * y * gxy + y * y * gyy;
  return std::max(left, 0.0);
}

MovementFit movement_fit(const PatchPair& pair, double noise, int offset, int around) {
  return fit_of({pair.before.smoother, pair.after.smoother, kSmootherScale}, noise, offset, around);
}

KeptShape kept_shape(const PatchPair& pair, double right_px, double down_px) {
  using Step = std::array<int, 2>;
  const auto whole = [](double right, double down) {
    const auto one = [](double px) {
      return static_cast<int>(std::lround(std::clamp(px, -1.0 * kFarthest, 1.0 * kFarthest)));
    };
    return Step{one(right), one(down)};
  };
  // Whole pixels first, then fractions. If that leads to other whole pixels, start again from
  // there.
  std::vector<Step> styles{{0, 0}};
  const auto look_at = [&](const Step& step) {
    if (std::ranges::find(styles, step) == styles.end()) styles.push_back(step);
  };
  look_at(whole(right_px, down_px));
  KeptShape kept;
  double energy = 0.0;
  for (std::size_t k = 0; k < std::min(styles.size(), kMostStyles); ++k) {
    const auto [right, down] = styles[k];
    const MovementFit fit = fit_of({pair.before.smooth, pair.after.smooth, kSmoothScale}, 1.0,
                                   down * kPatchSide + right, 0);
    if (k == 0) energy = fit.energy;
    if (energy == 0.0) return kept;
    auto [x, y] = fit.movement();
    const double part = std::min(1.0, kFarthestRest / std::max(std::hypot(x, y), 1e-9));
    x *= part, y *= part;
    const double left = fit.left(x, y) / energy;
    if (left >= kept.left) continue;
    kept = {left, right + x, down + y};
    if (k > 0) look_at(whole(right + x, down + y));
  }
  return kept;
}

bool TileEvidence::is_one_sided() const {
  const auto most = std::ranges::max_element(absolute_sum) - absolute_sum.begin();
  return std::abs(sum[most]) > 0.9 * absolute_sum[most];
}

TileEvidence tile_evidence(const Image& baseline, const Image& current, const PixelBox& tile,
                           const EvidenceBounds& bounds, TileMarks& marks) {
  TileEvidence found;
  PatchPair pair;
  load_patch(baseline, tile.x, tile.y, pair.before);
  load_patch(current, tile.x, tile.y, pair.after);
  const auto [x0, y0, width, height] = tile;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = cell_at(x, y);
      if (!pair.is_beyond(i, 0)) continue;
      ++found.differing;
      PixelMark& mark = marks[y * kTile + x];
      mark = PixelMark::kNoise;
      if (!pair.is_beyond(i, bounds.noise)) continue;
      mark = PixelMark::kSmoothed;
      ++found.beyond_noise;
      found.bold += is_bold(pair, i);
      found.lost += is_lost(pair, i, bounds.noise);
      if (pair.is_beyond(i, 2.0 * bounds.noise)) {
        ++found.clear;
        count_copies(pair, i, bounds.noise, found.copied);
      }
      for (int c = 0; c < 3; ++c) {
        const int difference = pair.after.raw[c][i] - pair.before.raw[c][i];
        found.sum[c] += difference, found.absolute_sum[c] += std::abs(difference);
      }
      found.largest_colour_difference =
          std::max(found.largest_colour_difference, colour_difference(pair, i));
    }
  found.sided = bounds.is_noisy ? found.clear : found.beyond_noise;
  const FlatSums flat = flat_sums(pair, bounds.noise, width, height);
  found.flat_shift = flat_shift(flat, bounds, bounds.is_noisy);
  found.flat_shift_in_noise = flat_shift(flat, bounds, true);
  if (!bounds.is_noisy) {
    const double film = film_shift(pair, bounds, width, height);
    found.flat_shift = std::max(found.flat_shift, film);
    found.flat_shift_in_noise = std::max(found.flat_shift_in_noise, film);
  }
  if (found.beyond_noise == 0) return found;
  find_displacement(pair, bounds, found);
  found.filter = filter_fit(pair, bounds.noise, width, height);
  const Recolouring recolouring = find_recolouring(pair, bounds.noise);
  found.recoloured_share = recolouring.share;
  found.recolouring = recolouring.off_line;
  found.edge_pixels = recolouring.pixels;
  const WindowStructure window = least_window_structure(pair, width, height);
  found.least_structure = window.structure;
  found.least_structure_at = {x0 + window.x, y0 + window.y, window.width, window.height};
  return found;
}

}  // namespace mapproof
