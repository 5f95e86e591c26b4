#pragma once

#include <string>
#include <vector>

#include "render/theme/font.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// A label with the short names of mapping methods: "SMACOF kNN, K = 7".
std::string short_method_name(const std::string& label);

/// The same, what else a figure compares short, too: "suggested, kNN".
std::string short_name(const std::string& label);

/// A label without values of parameters: "SMACOF kNN" of "SMACOF kNN, K = 7".
std::string without_parameters(const std::string& label);

/// The label as it stands in a figure of the theme: in one of a column's width the long names of
/// methods are short, "SMACOF, kNN weights, K = 7" is "SMACOF kNN, K = 7".
std::string label_in(const Theme& theme, const std::string& label);

/// The label in the theme, short if it is wider than `most` em, then without parameters unless one
/// of the others is then alike; with a "…" in its middle if it is too wide even so.
///
/// @param others  All labels beside it; it may be one of them.
ShapedText shape_label_within(const Theme& theme, const std::string& label, double most,
                              const std::vector<std::string>& others);

/// The label in the theme in lines of at most `most` em, as many as it takes: words that are wider
/// are broken, too. One that has no end in a figure is one line with a "…" in its middle.
std::vector<ShapedText> name_lines(const Theme& theme, const std::string& label, double most);

/// From one line of a name to the next, em.
inline constexpr double kNameLineStep = 1.15;

/// Whether a part of the text is left out.
bool is_elided(const ShapedText& text);

}  // namespace mapproof
