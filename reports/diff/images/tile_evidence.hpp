#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/filter_fit.hpp"
#include "reports/diff/images/image_changes.hpp"
#include "reports/diff/images/patch.hpp"

namespace mapproof {

/// Normal equations of the movement that explains a difference best by least squares [lucas1981].
struct MovementFit {
  double energy = 0.0;  ///< Sum of squares of the difference.
  double gxx = 0.0, gxy = 0.0, gyy = 0.0, gxd = 0.0, gyd = 0.0;

  void add(const MovementFit& other, double weight);
  /// The movement, right and down. Along a straight edge it is not determined, and taken as zero.
  std::array<double, 2> movement() const;
  /// The energy that remains after a movement.
  double left(double right_px, double down_px) const;
};

/// Fits the difference of the `smoother` planes.
/// @param noise   Of 255: values that differ by no more count as equal.
/// @param offset  In cells: the movement of the baseline before the fit.
/// @param around  Pixels around the tile that take part.
MovementFit movement_fit(const PatchPair& pair, double noise, int offset, int around);

/// A movement under which the shapes in a tile persist, found from slightly smoothed pixels. The
/// shapes of a letter with different hinting do not persist.
struct KeptShape {
  double left = 1.0;  ///< The share of the energy that remains after the movement; 0 to 1.
  double right_px = 0.0, down_px = 0.0;

  double displacement_px() const { return std::hypot(right_px, down_px); }
};

/// @param right_px, down_px  The first guess. Movements up to 3.75 px are found.
KeptShape kept_shape(const PatchPair& pair, double right_px, double down_px);

/// The steps to the eight neighbours of a pixel, right and down.
inline constexpr std::array<std::array<int, 2>, 8> kNeighbourSteps{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

/// The features of a tile's difference.
struct TileEvidence {
  int differing = 0;     ///< Pixels that differ at all.
  int beyond_noise = 0;  ///< Of them, those with a channel beyond the noise.
  int bold = 0;          ///< Of those, pixels that change more than a nearby edge explains.
  int lost = 0;          ///< Of those, pixels whose colour no neighbour in the other image has.
  /// Of 255: the change of the mean of flat pixels, in the whole tile or three of its rows or
  /// columns, less the part that noise explains; at most 0 if noise explains all.
  double flat_shift = -1.0;
  double flat_shift_in_noise = -1.0;  ///< The same, assuming noise everywhere.
  /// Of the pixels beyond noise: those beyond it twice. A colour that differs less is within noise
  /// of that of a neighbour, too.
  int clear = 0;
  int sided = 0;  ///< Pixels that may show a direction: where there is noise, the clear ones.
  /// Of the clear pixels: those with the former colour of the neighbour at each of kNeighbourSteps.
  std::array<int, 8> copied{};
  std::array<double, 3> sum{};           ///< Of the differences beyond noise, per channel.
  std::array<double, 3> absolute_sum{};  ///< Of their absolute values.
  MovementFit fit;                       ///< Of the smoothed difference.
  double right_px = 0.0, down_px = 0.0;  ///< The movement that explains most of it.
  double moved_share = 0.0;              ///< The share of the energy that this movement explains.
  double left_share = 1.0;  ///< The share that remains after a movement of at most 0.35 px.
  /// The same after a movement by whole pixels and a fraction; 1 if the movement is below half a
  /// pixel.
  double left_by_whole = 1.0;
  FilterFit filter;               ///< Of the raw difference.
  KeptShape kept;                 ///< Default where few pixels are beyond noise.
  double recoloured_share = 0.0;  ///< Of the raw energy, what a change of colours alone explains.
  double recolouring = 0.0;      ///< Of 255: distance of pixels from the line background to colour.
  int edge_pixels = 0;           ///< The pixels that determine recoloured_share.
  double least_structure = 1.0;  ///< Of its 8 x 8 windows [wang2004], by luma.
  PixelBox least_structure_at;
  double largest_colour_difference = 0.0;  ///< 0 to 1 [kotsarenko2010].

  double displacement_px() const { return std::hypot(right_px, down_px); }
  /// Whether pixels beyond noise change in one direction, darker or lighter, in the channel that
  /// changes most.
  bool is_one_sided() const;
};

/// The bounds by which evidence is judged.
struct EvidenceBounds {
  double noise = ImageTolerances::kNoise;  ///< Of 255: the allowed difference of one pixel.
  double mean_noise = ImageTolerances::kMeanNoise;  ///< Of 255: the allowed difference of a mean
                                                    ///< over any number of pixels.
  double displacement_px = ImageTolerances::kDisplacement_px;  ///< The allowed movement of a part.
  bool is_noisy = false;  ///< Whether there is noise everywhere; otherwise none is assumed.
};

/// Compares a tile, and the 6 pixels around it, and marks its pixels as equal, noise or smoothed.
/// @param tile  Cut off at the image's edge.
/// @pre The sizes of the images are equal.
TileEvidence tile_evidence(const Image& baseline, const Image& current, const PixelBox& tile,
                           const EvidenceBounds& bounds, TileMarks& marks);

}  // namespace mapproof
