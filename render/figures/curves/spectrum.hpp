#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// Singular values of one matrix of squared ranges.
struct SingularValues {
  std::string title;
  std::vector<double> values;         ///< Descending, >= 0.
  std::size_t rank = 4;               ///< How many are kept.
  std::optional<double> noise_level;  ///< What noise alone reaches.
};

struct SingularValuesSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::vector<SingularValues> panels;  ///< Those without values are left out.
  std::vector<std::string> record_ids;
};

/// Singular values on a logarithmic axis, those kept filled, and the noise floor: the level given,
/// or else the greatest value that is dropped. Ratios of the last one kept to it are in the titles.
/// @throws InvalidInput if a value is negative or infinite.
Figure singular_values_figure(const SingularValuesSpec& spec);

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
