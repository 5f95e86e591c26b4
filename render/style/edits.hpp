#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// The landmarks of a figure, by the data of its marks, each once, in the order of their marks.
std::vector<std::string> landmarks_of(const Figure& figure);

/// Names those landmarks and no others, at their true positions where these are drawn, else where
/// the figure has them. Those that a panel does not show are not named in it.
void name_landmarks(Figure& figure, const std::vector<std::string>& names);

/// Removes the marks of all other landmarks.
void show_landmarks(Figure& figure, const std::vector<std::string>& names);

/// Several figures as panels of one, in their order, each under its title and its score; panels
/// whose axes have one label, scale and names get the same limits.
/// @param titles  As many as figures; empty ones are the figure's own.
/// @throws InvalidInput if there are fewer than two figures.
Figure joined_figure(const std::string& id, const std::vector<Figure>& figures,
                     const std::vector<std::string>& titles = {});

}  // namespace mapproof
