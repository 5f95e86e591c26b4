#pragma once

#include <array>

#include "reports/diff/images/patch.hpp"

namespace mapproof {

/// Normal equations of the symmetric filter that explains a difference best by least squares: the
/// current image as the baseline plus what three binomial filters of 3, 5 and 9 pixels change of
/// it. Blur and sharpening are such filters. Anti-aliasing, hinting and movements are not.
struct FilterFit {
  std::array<double, 6> products{};  ///< Of what the filters change: the upper triangle.
  std::array<double, 3> right{};     ///< Of what they change and the difference.
  double energy = 0.0;               ///< Sum of squares of the difference.
  int values = 0;

  void add(const FilterFit& other);

  /// The filter itself.
  struct Filter {
    double explained = 0.0;     ///< Of the energy, 0 to 1.
    double variance_px2 = 0.0;  ///< Along an axis; negative: it sharpens.
  };
  Filter filter() const;
};

/// Fits the pixels of the tile that differ by more than noise, and their neighbours, without values
/// of 0 and 255 in the current image, which may be cut off.
/// @param width, height  Of the part of the tile inside the image.
FilterFit filter_fit(const PatchPair& pair, double noise, int width, int height);

}  // namespace mapproof
