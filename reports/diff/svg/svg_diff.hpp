#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mapproof {

struct SvgTree;

enum class SvgChangeKind { kGeometry, kStyle, kText, kStructure, kMetadata };

/// One thing that differs between two SVG files.
struct SvgChange {
  SvgChangeKind kind = SvgChangeKind::kStructure;
  std::string element;   ///< "svg/g#marks/circle#m17"; "[2]": the second of its name without an id.
  std::string what;      ///< "cx", "style: fill", "text", "added", "removed", "moved".
  std::string baseline;  ///< At most 120 characters of each value.
  std::string current;
  double distance = 0.0;  ///< User units, or of 255 for colours; 0 if it is not about numbers.
  bool tolerated = false;
};

struct SvgDiff {
  std::vector<SvgChange> changes;  ///< The first 200, those that are not tolerated first.
  std::int64_t total = 0;          ///< Of all kinds, tolerated ones too.
  std::int64_t tolerated = 0;
  std::int64_t geometry = 0, style = 0, text = 0, structure = 0, metadata = 0;
};

/// Differences that nobody sees.
struct SvgTolerances {
  double distance_px = 0.15;  ///< Pixels as drawn, >= 0: how far geometry may be moved.
  double colour = 0.0;        ///< Of 255, >= 0: what a channel of a colour may differ.
};

/// Compares two SVG files element by element, never by bytes: what is written otherwise and means
/// the same is not a change. Numbers of style may differ by 0.001; remarks (metadata, data-*, ids
/// that nothing else tells) are listed as changes and always tolerated.
/// @throws InvalidInput if a tolerance is negative or not a number.
SvgDiff svg_diff(const SvgTree& baseline, const SvgTree& current,
                 const SvgTolerances& tolerances = {});

}  // namespace mapproof
