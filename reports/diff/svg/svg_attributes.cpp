#include "reports/diff/svg/svg_attributes.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

void skip_separators(std::string_view& text) {
  while (!text.empty() &&
         (std::isspace(static_cast<unsigned char>(text.front())) || text.front() == ','))
    text.remove_prefix(1);
}

/// How many numbers a command takes; -1 if it is none.
int arity(char command) {
  switch (command) {
    case 'Z':
      return 0;
    case 'H':
    case 'V':
      return 1;
    case 'M':
    case 'L':
    case 'T':
      return 2;
    case 'S':
    case 'Q':
      return 4;
    case 'C':
      return 6;
    case 'A':
      return 7;
    default:
      return -1;
  }
}

/// Reads the arguments of one command; the flags of an arc may stand without blanks.
bool read_arguments(char command, std::string_view& data, std::array<double, 7>& out) {
  for (int i = 0; i < arity(command); ++i) {
    skip_separators(data);
    if (command == 'A' && (i == 3 || i == 4)) {
      if (data.empty() || (data.front() != '0' && data.front() != '1')) return false;
      out[i] = data.front() - '0';
      data.remove_prefix(1);
      continue;
    }
    const std::size_t used = read_number(data, out[i]);
    if (used == 0) return false;
    data.remove_prefix(used);
  }
  return true;
}

struct Pen {
  double x = 0, y = 0, start_x = 0, start_y = 0;

  /// Makes relative arguments absolute and moves on.
  void follow(char command, bool is_relative, std::array<double, 7>& a) {
    const int count = arity(command);
    const double ox = is_relative ? x : 0.0, oy = is_relative ? y : 0.0;
    if (command == 'Z') {
      x = start_x, y = start_y;
    } else if (command == 'H') {
      x = a[0] += ox;
    } else if (command == 'V') {
      y = a[0] += oy;
    } else {
      for (int i = command == 'A' ? 5 : 0; i < count; i += 2) a[i] += ox, a[i + 1] += oy;
      x = a[count - 2], y = a[count - 1];
    }
    if (command == 'M') start_x = x, start_y = y;
  }
};

using Matrix = std::array<double, 6>;

Matrix product(const Matrix& p, const Matrix& q) {
  return {p[0] * q[0] + p[2] * q[1],        p[1] * q[0] + p[3] * q[1],
          p[0] * q[2] + p[2] * q[3],        p[1] * q[2] + p[3] * q[3],
          p[0] * q[4] + p[2] * q[5] + p[4], p[1] * q[4] + p[3] * q[5] + p[5]};
}

std::optional<Matrix> matrix_of(std::string_view name, const std::vector<double>& v) {
  const std::size_t n = v.size();
  const double radian = std::numbers::pi / 180.0;
  if (name == "matrix" && n == 6) return Matrix{v[0], v[1], v[2], v[3], v[4], v[5]};
  if (name == "translate" && (n == 1 || n == 2)) return Matrix{1, 0, 0, 1, v[0], n == 2 ? v[1] : 0};
  if (name == "scale" && (n == 1 || n == 2)) return Matrix{v[0], 0, 0, n == 2 ? v[1] : v[0], 0, 0};
  if (name == "skewX" && n == 1) return Matrix{1, 0, std::tan(v[0] * radian), 1, 0, 0};
  if (name == "skewY" && n == 1) return Matrix{1, std::tan(v[0] * radian), 0, 1, 0, 0};
  if (name != "rotate" || (n != 1 && n != 3)) return std::nullopt;
  const double c = std::cos(v[0] * radian), s = std::sin(v[0] * radian);
  const Matrix turn{c, s, -s, c, 0, 0};
  if (n == 1) return turn;
  return product(product({1, 0, 0, 1, v[1], v[2]}, turn), {1, 0, 0, 1, -v[1], -v[2]});
}

/// The colours that CSS names (CSS Color Module Level 4, 6.1): name and RRGGBB in turn.
constexpr std::string_view kColours =
    " aliceblue F0F8FF antiquewhite FAEBD7 aqua 00FFFF aquamarine 7FFFD4 azure F0FFFF"
    " beige F5F5DC bisque FFE4C4 black 000000 blanchedalmond FFEBCD blue 0000FF blueviolet 8A2BE2"
    " brown A52A2A burlywood DEB887 cadetblue 5F9EA0 chartreuse 7FFF00 chocolate D2691E"
    " coral FF7F50 cornflowerblue 6495ED cornsilk FFF8DC crimson DC143C cyan 00FFFF"
    " darkblue 00008B darkcyan 008B8B darkgoldenrod B8860B darkgray A9A9A9 darkgreen 006400"
    " darkgrey A9A9A9 darkkhaki BDB76B darkmagenta 8B008B darkolivegreen 556B2F darkorange FF8C00"
    " darkorchid 9932CC darkred 8B0000 darksalmon E9967A darkseagreen 8FBC8F darkslateblue 483D8B"
    " darkslategray 2F4F4F darkslategrey 2F4F4F darkturquoise 00CED1 darkviolet 9400D3"
    " deeppink FF1493 deepskyblue 00BFFF dimgray 696969 dimgrey 696969 dodgerblue 1E90FF"
    " firebrick B22222 floralwhite FFFAF0 forestgreen 228B22 fuchsia FF00FF gainsboro DCDCDC"
    " ghostwhite F8F8FF gold FFD700 goldenrod DAA520 gray 808080 green 008000 greenyellow ADFF2F"
    " grey 808080 honeydew F0FFF0 hotpink FF69B4 indianred CD5C5C indigo 4B0082 ivory FFFFF0"
    " khaki F0E68C lavender E6E6FA lavenderblush FFF0F5 lawngreen 7CFC00 lemonchiffon FFFACD"
    " lightblue ADD8E6 lightcoral F08080 lightcyan E0FFFF lightgoldenrodyellow FAFAD2"
    " lightgray D3D3D3 lightgreen 90EE90 lightgrey D3D3D3 lightpink FFB6C1 lightsalmon FFA07A"
    " lightseagreen 20B2AA lightskyblue 87CEFA lightslategray 778899 lightslategrey 778899"
    " lightsteelblue B0C4DE lightyellow FFFFE0 lime 00FF00 limegreen 32CD32 linen FAF0E6"
    " magenta FF00FF maroon 800000 mediumaquamarine 66CDAA mediumblue 0000CD mediumorchid BA55D3"
    " mediumpurple 9370DB mediumseagreen 3CB371 mediumslateblue 7B68EE mediumspringgreen 00FA9A"
    " mediumturquoise 48D1CC mediumvioletred C71585 midnightblue 191970 mintcream F5FFFA"
    " mistyrose FFE4E1 moccasin FFE4B5 navajowhite FFDEAD navy 000080 oldlace FDF5E6 olive 808000"
    " olivedrab 6B8E23 orange FFA500 orangered FF4500 orchid DA70D6 palegoldenrod EEE8AA"
    " palegreen 98FB98 paleturquoise AFEEEE palevioletred DB7093 papayawhip FFEFD5"
    " peachpuff FFDAB9 peru CD853F pink FFC0CB plum DDA0DD powderblue B0E0E6 purple 800080"
    " rebeccapurple 663399 red FF0000 rosybrown BC8F8F royalblue 4169E1 saddlebrown 8B4513"
    " salmon FA8072 sandybrown F4A460 seagreen 2E8B57 seashell FFF5EE sienna A0522D silver C0C0C0"
    " skyblue 87CEEB slateblue 6A5ACD slategray 708090 slategrey 708090 snow FFFAFA"
    " springgreen 00FF7F steelblue 4682B4 tan D2B48C teal 008080 thistle D8BFD8 tomato FF6347"
    " turquoise 40E0D0 violet EE82EE wheat F5DEB3 white FFFFFF whitesmoke F5F5F5 yellow FFFF00"
    " yellowgreen 9ACD32 ";

/// 0xRRGGBB of a colour's name in lower case.
std::optional<std::uint32_t> named_colour(std::string_view name) {
  if (name.empty() || !std::ranges::all_of(name, [](char c) { return c >= 'a' && c <= 'z'; }))
    return std::nullopt;
  const std::string key = " " + std::string(name) + " ";
  const std::size_t at = kColours.find(key);
  if (at == std::string_view::npos) return std::nullopt;
  std::uint32_t rgb = 0;
  const char* digits = kColours.data() + at + key.size();
  std::from_chars(digits, digits + 6, rgb, 16);
  return rgb;
}

/// A value in pieces: numbers, and what stands between them.
struct Pieces {
  std::vector<double> numbers;
  std::string rest;  ///< A '\1' for each number; blanks, commas and the unit "px" left out.
};

Pieces pieces_of(std::string_view text) {
  Pieces pieces;
  while (!text.empty()) {
    double number = 0.0;
    const std::size_t used = read_number(text, number);
    // A digit within a word, as in "Arial2", is not a number.
    const bool in_word =
        !pieces.rest.empty() &&
        (std::isalpha(static_cast<unsigned char>(pieces.rest.back())) || pieces.rest.back() == '#');
    if (used > 0 && !in_word) {
      pieces.numbers.push_back(number);
      pieces.rest += '\1';
      text.remove_prefix(used);
      if (text.starts_with("px")) text.remove_prefix(2);
      continue;
    }
    const std::size_t count = std::max<std::size_t>(used, 1);
    for (const char c : text.substr(0, count))
      if (c != ' ' && c != ',') pieces.rest += c;
    text.remove_prefix(count);
  }
  return pieces;
}

ValueDistance distance_of(const std::vector<double>& a, const std::vector<double>& b) {
  ValueDistance found{true, false, 0.0};
  for (std::size_t i = 0; i < a.size(); ++i)
    // A matrix may have overflowed.
    found.distance = a[i] == b[i]                 ? found.distance
                     : std::isfinite(a[i] - b[i]) ? std::max(found.distance, std::abs(a[i] - b[i]))
                                                  : std::numeric_limits<double>::max();
  return found;
}

bool holds_a_colour(std::string_view name) {
  constexpr std::array<std::string_view, 6> kNames = {"fill",        "stroke", "stop-color",
                                                      "flood-color", "color",  "lighting-color"};
  return std::ranges::find(kNames, name) != kNames.end();
}

}  // namespace

std::size_t read_number(std::string_view text, double& number) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  const std::string_view digits = text.substr(sign);
  const std::size_t first = digits.starts_with('-') && sign == 0 ? 1 : 0;
  if (digits.size() <= first) return 0;
  const auto is_digit_at = [&](std::size_t i) {
    return i < digits.size() && std::isdigit(static_cast<unsigned char>(digits[i]));
  };
  // Neither "inf" nor "nan".
  if (!is_digit_at(first) && !(digits[first] == '.' && is_digit_at(first + 1))) return 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return 0;
  return sign + static_cast<std::size_t>(end - digits.data());
}

std::optional<NumbersAndWords> path_numbers(std::string_view data) {
  NumbersAndWords path;
  Pen pen;
  char command = 0;
  bool is_relative = false;
  for (skip_separators(data); !data.empty(); skip_separators(data)) {
    if (std::isalpha(static_cast<unsigned char>(data.front()))) {
      is_relative = std::islower(static_cast<unsigned char>(data.front()));
      command = static_cast<char>(std::toupper(static_cast<unsigned char>(data.front())));
      data.remove_prefix(1);
      if (arity(command) < 0) return std::nullopt;
    } else if (command == 0 || command == 'Z') {
      return std::nullopt;
    } else if (command == 'M') {
      command = 'L';  // Further pairs after a move are lines.
    }
    std::array<double, 7> arguments{};
    if (!read_arguments(command, data, arguments)) return std::nullopt;
    pen.follow(command, is_relative, arguments);
    path.words += command;
    path.numbers.insert(path.numbers.end(), arguments.begin(), arguments.begin() + arity(command));
  }
  return path;
}

std::optional<NumbersAndWords> matrix_numbers(std::string_view transforms) {
  Matrix all{1, 0, 0, 1, 0, 0};
  for (skip_separators(transforms); !transforms.empty(); skip_separators(transforms)) {
    const std::size_t open = transforms.find('('), close = transforms.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open)
      return std::nullopt;
    std::string_view name = transforms.substr(0, open),
                     list = transforms.substr(open + 1, close - open - 1);
    while (name.ends_with(' ')) name.remove_suffix(1);
    transforms.remove_prefix(close + 1);
    std::vector<double> values;
    for (skip_separators(list); !list.empty(); skip_separators(list)) {
      double value = 0.0;
      const std::size_t used = read_number(list, value);
      if (used == 0) return std::nullopt;
      values.push_back(value);
      list.remove_prefix(used);
    }
    const std::optional<Matrix> one = matrix_of(name, values);
    if (!one) return std::nullopt;
    all = product(all, *one);
  }
  return NumbersAndWords{"matrix", {all.begin(), all.end()}};
}

std::optional<std::array<double, 3>> css_colour(std::string_view text) {
  const auto of = [](std::uint32_t rgb) {
    return std::array<double, 3>{double(rgb >> 16), double((rgb >> 8) & 0xFF), double(rgb & 0xFF)};
  };
  const std::string word = lower_case(text);
  if (word.starts_with('#')) {
    std::uint32_t value = 0;
    const auto [end, error] =
        std::from_chars(word.data() + 1, word.data() + word.size(), value, 16);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    if (word.size() == 7) return of(value);
    if (word.size() != 4) return std::nullopt;
    return of((value >> 8) * 0x110000 + ((value >> 4) & 0xF) * 0x1100 + (value & 0xF) * 0x11);
  }
  if (word.starts_with("rgb(")) {
    const Pieces pieces = pieces_of(std::string_view(word).substr(3));
    if (pieces.numbers.size() != 3) return std::nullopt;
    const bool is_share = pieces.rest == "(\1%\1%\1%)";
    if (!is_share && pieces.rest != "(\1\1\1)") return std::nullopt;
    std::array<double, 3> colour{};
    for (int c = 0; c < 3; ++c)
      colour[c] = std::clamp(pieces.numbers[c] * (is_share ? 255.0 : 100.0) / 100.0, 0.0, 255.0);
    return colour;
  }
  if (const auto named = named_colour(word)) return of(*named);
  return std::nullopt;
}

ValueDistance value_distance(std::string_view name, std::string_view a, std::string_view b) {
  if (a == b) return {true, false, 0.0};
  if (holds_a_colour(name)) {
    const auto first = css_colour(a), second = css_colour(b);
    if (first && second) {
      ValueDistance found =
          distance_of({first->begin(), first->end()}, {second->begin(), second->end()});
      found.is_colour = true;
      return found;
    }
  }
  if (name == "d" || name == "transform" || name.ends_with("Transform")) {
    const auto read = name == "d" ? &path_numbers : &matrix_numbers;
    const auto first = read(a), second = read(b);
    if (first && second && first->words == second->words)
      return distance_of(first->numbers, second->numbers);
  }
  const Pieces first = pieces_of(a), second = pieces_of(b);
  if (first.rest != second.rest) return {};
  return distance_of(first.numbers, second.numbers);
}

std::optional<TransformDistance> transform_distance(std::string_view a, std::string_view b) {
  const auto first = matrix_numbers(a), second = matrix_numbers(b);
  if (!first || !second) return std::nullopt;
  const auto apart = [&](std::size_t i) { return first->numbers[i] - second->numbers[i]; };
  TransformDistance distance{.shift = std::hypot(apart(4), apart(5))};
  for (const std::size_t i : {0U, 1U, 2U, 3U})
    distance.linear = std::max(distance.linear, std::abs(apart(i)));
  return distance;
}

}  // namespace mapproof
