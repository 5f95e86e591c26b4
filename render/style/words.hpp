#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "render/plot/figure.hpp"
#include "render/scene/scene.hpp"

#include "render/style/figure_style.hpp"

namespace mapproof {

/// The languages that figures can have: "de", "en", "es", "fr".
std::vector<std::string_view> languages();

/// English phrases of figures and what they are in a language; none of English or an empty name.
/// @throws InvalidInput for a language that is not known, with those that are.
std::map<std::string, std::string> language_words(std::string_view language);

/// `text` with its phrases replaced: the longest one at each word, whole words alone, none twice.
std::string replaced(std::string_view text, const std::map<std::string, std::string>& words);

/// Replaces phrases in all texts but the names beside points: titles, notes, axes, legends, caption
/// and description.
void replace_words(Figure& figure, const std::map<std::string, std::string>& words);
void replace_words(Scene& scene, const std::map<std::string, std::string>& words);

/// The phrases that a style replaces: those of its language, under its own words.
/// @throws InvalidInput for a language that is not known.
std::map<std::string, std::string> words_of(const FigureStyle& style);

}  // namespace mapproof
