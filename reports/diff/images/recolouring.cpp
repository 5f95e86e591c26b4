#include "reports/diff/images/recolouring.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace mapproof {
namespace {

struct Pixel {
  Eigen::Vector3d before, difference;
};

Eigen::Vector3d colour_at(const Patch& patch, int cell) {
  return {double(patch.raw[0][cell]), double(patch.raw[1][cell]), double(patch.raw[2][cell])};
}

/// Pixels of the tile that differ beyond the noise and those beside them.
std::vector<Pixel> pixels_near_differences(const PatchPair& pair, double noise) {
  std::array<bool, kPatchCells> near{};
  for (int y = 0; y < kTile; ++y)
    for (int x = 0; x < kTile; ++x)
      if (const int cell = cell_at(x, y); pair.is_beyond(cell, noise))
        for (const int row : {cell - kPatchSide, cell, cell + kPatchSide})
          for (const int i : {row - 1, row, row + 1}) near[i] = true;
  std::vector<Pixel> pixels;
  for (int i = 0; i < kPatchCells; ++i)
    if (near[i]) {
      const Eigen::Vector3d before = colour_at(pair.before, i);
      pixels.push_back({before, colour_at(pair.after, i) - before});
    }
  return pixels;
}

}  // namespace

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
    const Eigen::Vector3d told = map.transpose() * row_of(pixel);
    rest += (pixel.difference - told).squaredNorm();
    const Eigen::Vector3d ink = pixel.before - paper;
    const double length = ink.norm();
    if (length >= 8.0)
      found.off_line =
          std::max(found.off_line, (told - told.dot(ink) / (length * length) * ink).norm());
  }
  found.share = 1.0 - rest / energy;
  return found;
}

}  // namespace mapproof
