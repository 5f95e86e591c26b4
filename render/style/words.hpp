#pragma once

#include <functional>
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

/// All texts but the names beside points: titles, notes, axes, legends, caption and description.
void for_each_text(Figure& figure, const std::function<void(std::string& text)>& use);
void for_each_text(Scene& scene, const std::function<void(std::string& text)>& use);

/// Whether the phrases leave no word of a text as it is: none but names, symbols and abbreviations,
/// which have capitals or digits (ISOMAP, kNN, K).
bool replaces_all(std::string_view text, const std::map<std::string, std::string>& words,
                  const std::vector<std::string>& names);

/// Replaces the phrases of a style in these texts. In another language sentences (captions,
/// descriptions and notes) are replaced as a whole, or stay in English.
/// @throws InvalidInput for a language that is not known.
void replace_words(Figure& figure, const FigureStyle& style);
void replace_words(Scene& scene, const FigureStyle& style);

/// Refuses phrases of a style that none of the texts has, nor the words of any language: they are
/// of no figure. @throws IoError naming the nearest one that is known.
/// @param texts  Of all that is drawn, before phrases are replaced.
void require_known_phrases(const FigureStyle& style, const std::vector<std::string>& texts,
                           const std::string& source);

/// The phrases that a style replaces: those of its language, under its own words.
/// @throws InvalidInput for a language that is not known.
std::map<std::string, std::string> words_of(const FigureStyle& style);

}  // namespace mapproof
