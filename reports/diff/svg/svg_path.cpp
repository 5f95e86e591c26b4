#include "reports/diff/svg/svg_path.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

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

}  // namespace

std::size_t read_number(std::string_view text, double& number) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  const std::string_view digits = text.substr(sign);
  const std::size_t first = digits.starts_with('-') && sign == 0 ? 1 : 0;
  if (digits.size() <= first) return 0;
  const auto is_digit = [&](std::size_t i) {
    return i < digits.size() && std::isdigit(static_cast<unsigned char>(digits[i]));
  };
  // Neither "inf" nor "nan".
  if (!is_digit(first) && !(digits[first] == '.' && is_digit(first + 1))) return 0;
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

}  // namespace mapproof
