#pragma once

#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// One method's eigenvalues, those of the map's two axes first.
struct SpectrumPanel {
  std::string title;
  std::vector<double> eigenvalues;  ///< Descending, or ascending where the least ones make the map.
};

struct SpectrumSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::vector<SpectrumPanel> methods;  ///< Those without eigenvalues are left out, and named.
  std::vector<std::string> record_ids;
};

/// How far the map's two eigenvalues stand out: the ratio of the second and the third, >= 1 if they
/// are ordered; NaN if there are not three, or one of the two is not positive.
double spectral_gap(const std::vector<double>& eigenvalues);

/// Eigenvalues in shares of the greatest on a logarithmic axis, a small panel a method; the map's
/// two filled, the spectral gap in the title.
/// @throws InvalidInput if an eigenvalue is infinite.
Figure spectrum_figure(const SpectrumSpec& spec);

}  // namespace mapproof
