#include "render/figures/curves/best_line.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/diverged.hpp"
#include "render/plot/short_names.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostNamed = 3;
constexpr const char* kNotSignificant = "differences are not significant";
constexpr std::size_t kMostOthers = 2;  ///< Behind a finding about most of the lines.

/// A line's value at one x.
struct At {
  const ErrorLine* line = nullptr;
  std::size_t index = 0;

  double x() const { return line->x[index]; }
  double mean() const { return line->mean[index]; }
  bool has_interval() const {
    return !line->low.empty() && std::isfinite(line->low[index] + line->high[index]);
  }
  PairedWithBest paired() const {
    return line->paired.empty() ? PairedWithBest::kUntested : line->paired[index];
  }
  bool is_tested() const { return paired() != PairedWithBest::kUntested; }
};

bool overlap(const At& a, const At& b) {
  return a.has_interval() && b.has_interval() && a.line->low[a.index] <= b.line->high[b.index] &&
         b.line->low[b.index] <= a.line->high[a.index];
}

/// What the lines know at x.
std::vector<At> known_at(const std::vector<ErrorLine>& lines, double x) {
  std::vector<At> known;
  for (const ErrorLine& line : lines)
    for (std::size_t i = 0; i < line.x.size(); ++i)
      if (line.x[i] == x && std::isfinite(line.mean[i])) known.push_back({&line, i});
  return known;
}

std::vector<At> all_known(const std::vector<ErrorLine>& lines) {
  std::vector<At> known;
  for (const ErrorLine& line : lines)
    for (std::size_t i = 0; i < line.x.size(); ++i)
      if (std::isfinite(line.mean[i])) known.push_back({&line, i});
  return known;
}

At best_in(const std::vector<At>& known, const LineQuantity& quantity) {
  return *std::ranges::min_element(known, [&](const At& a, const At& b) {
    return quantity.lower_is_better ? a.mean() < b.mean() : a.mean() > b.mean();
  });
}

/// "has the lowest MPE", "have the highest share".
std::string has_the_best(const LineQuantity& quantity, bool several) {
  return fmt::format("{} the {} {}", several ? "have" : "has",
                     quantity.lower_is_better ? "lowest" : "highest", quantity.label);
}

std::string value_text(double value, const LineQuantity& quantity) {
  return quantity.has_diverged(value) ? kGreatErrorText : quantity_text(value, quantity.unit);
}

std::vector<std::string> value_texts(const std::vector<double>& values,
                                     const LineQuantity& quantity) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(value_text(value, quantity));
  return texts;
}

std::set<double> xs_of(const std::vector<ErrorLine>& lines) {
  std::set<double> xs;
  for (const At& at : all_known(lines)) xs.insert(at.x());
  return xs;
}

/// "LLE and HLLE"; "3 of 8 methods" of names that would take the most of a title. Commas separate
/// the names of a list: where one has a comma, all are in quotes. A name alone is not in a list.
std::string listed_names(const std::vector<At>& some, const std::vector<ErrorLine>& lines) {
  constexpr std::size_t kMostCharacters = 50;
  std::vector<std::string> names;
  std::size_t characters = 0;
  for (const At& at : some) {
    names.push_back(line_name(*at.line, lines));
    characters += names.back().size();
  }
  if (names.size() > 1 && characters > kMostCharacters)
    return fmt::format("{} of {} methods", names.size(), lines.size());
  const auto has_comma = [](const std::string& one) { return one.find(", ") != std::string::npos; };
  if (names.size() > 1 && std::ranges::any_of(names, has_comma))
    for (std::string& one : names) one = "\u201c" + one + "\u201d";
  return listed(names, kMostNamed);
}

/// Whether two values have the same digits shown.
bool are_shown_alike(const At& a, const At& b, const LineQuantity& quantity) {
  if (a.mean() == b.mean()) return true;
  const std::vector<std::string> texts = value_texts({a.mean(), b.mean()}, quantity);
  return texts[0] == texts[1];
}

/// Whether the paired test or, without one, their intervals do not tell a value from the best. The
/// interval of what diverged reaches far down and shows nothing.
bool is_alike(const At& at, const At& best, const LineQuantity& quantity) {
  if (quantity.has_diverged(at.mean()) || quantity.has_diverged(best.mean())) return false;
  const bool have_test = at.is_tested() && best.paired() == PairedWithBest::kBest;
  return have_test ? at.paired() == PairedWithBest::kAlike : overlap(at, best);
}

/// Whether no reader should rank a value behind the best.
bool tie(const At& at, const At& best, const LineQuantity& quantity) {
  return is_alike(at, best, quantity) || are_shown_alike(at, best, quantity);
}

/// Whether a value ties with the best by its own spread alone: with an interval as narrow as the
/// best's it would not.
bool is_far_from(const At& best, const At& at) {
  return best.has_interval() && std::abs(at.mean() - best.mean()) >
                                    best.line->high[best.index] - best.line->low[best.index];
}

/// Those that tie with the best, the best first, and the others, ascending from the best on.
struct Contest {
  std::vector<At> equal, others;
};

Contest contest_of(std::vector<At> known, const LineQuantity& quantity) {
  std::ranges::stable_sort(known, [&](const At& a, const At& b) {
    return quantity.lower_is_better ? a.mean() < b.mean() : a.mean() > b.mean();
  });
  Contest contest;
  for (const At& at : known) {
    const bool is_equal = contest.equal.empty() || tie(at, contest.equal.front(), quantity);
    (is_equal ? contest.equal : contest.others).push_back(at);
  }
  return contest;
}

/// "0.19 m to 0.23 m"; one value if both round to the same.
std::string span_text(const std::vector<At>& some, const LineQuantity& quantity) {
  const auto [least, greatest] = std::ranges::minmax(some, {}, &At::mean);
  const std::vector<std::string> texts = value_texts({least.mean(), greatest.mean()}, quantity);
  return texts[0] == texts[1] ? texts[0] : texts[0] + " to " + texts[1];
}

/// Of many lines that tie with the best: "after 2000 steps, 4 of 5 methods have
/// an MPE of 0.19 m to 0.23 m, LEM 0.40 m".
std::string equal_words(const Contest& contest, const std::vector<ErrorLine>& lines,
                        const LineQuantity& quantity, const std::string& where) {
  const std::size_t all = contest.equal.size() + contest.others.size();
  const std::string number =
      contest.others.empty() ? "all" : fmt::format("{}", contest.equal.size());
  std::string text;
  if (!quantity.family.empty())
    text = fmt::format("{}, {} of {} have", where, number, quantity.family);
  else if (contest.others.empty())
    text =
        fmt::format("{}, {} methods have", where, all == 2 ? "both" : fmt::format("all {}", all));
  else
    text = fmt::format("{}, {} of {} methods have", where, number, all);
  text +=
      fmt::format(" {} of {}", with_article(quantity.label), span_text(contest.equal, quantity));
  if (contest.others.empty()) return text;
  if (contest.others.size() > kMostOthers)
    return fmt::format("{}, the others {}", text, span_text(contest.others, quantity));
  std::vector<std::string> others;
  for (const At& at : contest.others)
    others.push_back(line_name(*at.line, lines) + " " + value_text(at.mean(), quantity));
  return fmt::format("{}, {}", text, listed(others, kMostOthers));
}

/// The lines that are best at an x, several if they tie.
std::vector<At> best_at(const std::vector<ErrorLine>& lines, double x,
                        const LineQuantity& quantity) {
  return contest_of(known_at(lines, x), quantity).equal;
}

bool is_plural(const ErrorLine& line, const LineQuantity& quantity) {
  return std::ranges::find(quantity.plural, line.label) != quantity.plural.end();
}

bool has_line(const std::vector<At>& some, const ErrorLine* line) {
  return std::ranges::find(some, line, &At::line) != some.end();
}

bool are_alike(const std::vector<At>& a, const std::vector<At>& b) {
  return a.size() == b.size() &&
         std::ranges::all_of(a, [&](const At& at) { return has_line(b, at.line); });
}

/// Whether at some x another line is better than all of these, by digits that are shown.
bool is_beaten(const std::vector<At>& some, const std::vector<ErrorLine>& lines,
               const std::set<double>& xs, const LineQuantity& quantity) {
  return std::ranges::any_of(xs, [&](double x) {
    const Contest contest = contest_of(known_at(lines, x), quantity);
    const auto ours =
        std::ranges::find_if(contest.equal, [&](const At& at) { return has_line(some, at.line); });
    if (ours == contest.equal.end() || ours == contest.equal.begin()) return false;
    const std::vector<std::string> texts =
        value_texts({contest.equal.front().mean(), ours->mean()}, quantity);
    return texts[0] != texts[1];
  });
}

/// "SMACOF has the lowest mean MPE up to 10°, HLLE from 20° on"; empty unless one line leads up to
/// some point and another one from there on.
/// @param best  Those that tie with the leader at each x, which is the first of them.
std::string change_of_lead(const std::vector<std::vector<At>>& best,
                           const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                           const LineAxis& axis) {
  const ErrorLine *first = best.front().front().line, *last = best.back().front().line;
  const auto leads = [](const ErrorLine* line) {
    return [line](const std::vector<At>& one) { return one.front().line == line; };
  };
  const auto change = std::ranges::find_if_not(best, leads(first));
  if (change == best.end() || !std::all_of(change, best.end(), leads(last))) return "";
  const auto before = std::prev(change);
  const std::string until = x_text(axis, before->front().x(), quantity);
  const std::string from = x_text(axis, change->front().x(), quantity);
  return fmt::format("{} has the {} mean {} {}, {} {}", line_name(*first, lines),
                     quantity.lower_is_better ? "lowest" : "highest", quantity.label,
                     (before == best.begin() ? "at " : "up to ") + until, line_name(*last, lines),
                     std::next(change) == best.end() ? "at " + from : "from " + from + " on");
}

/// "10°, 20° and 40°"; of many "7 of 9 points".
std::string places(const LineAxis& axis, const std::vector<double>& some, std::size_t all,
                   const LineQuantity& quantity) {
  if (some.size() > kMostNamed) return fmt::format("{} of {} points", some.size(), all);
  std::vector<std::string> texts = {x_text(axis, some.front(), quantity)};
  for (std::size_t i = 1; i < some.size(); ++i)
    texts.push_back(with_unit(data_number(some[i]), axis.unit));
  return listed(texts, kMostNamed);
}

/// "SDE has the lowest mean MPE at 5 of 7 points, where it ties with others": the line that leads,
/// by digits that are shown, at the most points. Empty if none does, or two do equally often.
/// @param best  As of change_of_lead().
std::string most_frequent_lead(const std::vector<std::vector<At>>& best,
                               const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                               const LineAxis& axis) {
  const ErrorLine* leader = nullptr;
  std::vector<double> most;
  for (const ErrorLine& line : lines) {
    std::vector<double> led;
    for (const std::vector<At>& one : best)
      if (one.size() > 1 && one[0].line == &line && !are_shown_alike(one[0], one[1], quantity))
        led.push_back(one[0].x());
    if (led.empty() || led.size() < most.size()) continue;
    leader = led.size() == most.size() ? nullptr : &line;
    most = std::move(led);
  }
  if (leader == nullptr) return "";
  const bool are_several = is_plural(*leader, quantity);
  return fmt::format("{} {} the {} mean {} at {}, where {} with others", line_name(*leader, lines),
                     are_several ? "have" : "has", quantity.lower_is_better ? "lowest" : "highest",
                     quantity.label, places(axis, most, best.size(), quantity),
                     are_several ? "they tie" : "it ties");
}

}  // namespace

bool LineQuantity::has_diverged(double value) const {
  return value > divergence_in(unit, great_errors);
}

std::string x_text(const LineAxis& axis, double x, const LineQuantity& quantity) {
  const std::string value = with_unit(data_number(x), axis.unit);
  const bool is_clear = !axis.unit.empty() && axis.unit != quantity.unit;
  return is_clear ? value : fmt::format("{}\u00A0=\u00A0{}", axis.name, value);
}

std::string name_alone(const std::string& label) {
  return without_parameters(short_method_name(label));
}

std::string line_name(const ErrorLine& line, const std::vector<ErrorLine>& lines) {
  const std::string name = name_alone(line.label);
  const bool is_unique = std::ranges::none_of(lines, [&](const ErrorLine& other) {
    return other.label != line.label && name_alone(other.label) == name;
  });
  return is_unique ? name : short_method_name(line.label);
}

std::string with_article(const std::string& label) {
  constexpr std::string_view kSpoken = "AEFHILMNORSX";  // Letters whose names begin with a vowel.
  constexpr std::string_view kVowels = "aeiouAEIOU";
  const auto is_capital = [&](std::size_t i) { return label[i] >= 'A' && label[i] <= 'Z'; };
  const bool is_initials = label.size() > 1 && is_capital(0) && is_capital(1);
  const bool has_vowel =
      !label.empty() && (is_initials ? kSpoken : kVowels).find(label[0]) != std::string_view::npos;
  return (has_vowel ? "an " : "a ") + label;
}

std::string best_at_end(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                        const std::string& where) {
  const std::set<double> xs = xs_of(lines);
  if (xs.empty()) return "";
  const Contest contest = contest_of(known_at(lines, *xs.rbegin()), quantity);
  const std::string at = fmt::format(fmt::runtime(where), data_number(*xs.rbegin()));
  if (lines.size() == 1)
    return fmt::format("{} has {} of {} {}", line_name(lines.front(), lines),
                       with_article(quantity.label),
                       value_text(contest.equal.front().mean(), quantity), at);
  if (contest.equal.size() > kMostNamed || (contest.others.empty() && contest.equal.size() > 1))
    return equal_words(contest, lines, quantity, at);
  std::vector<double> means;
  for (const At& one : contest.equal) means.push_back(one.mean());
  const std::string family = quantity.family.empty() ? "" : fmt::format("of {}, ", quantity.family);
  return fmt::format("{}{} {} {}, {}", family, listed_names(contest.equal, lines),
                     has_the_best(quantity, contest.equal.size() > 1), at,
                     listed(value_texts(means, quantity), kMostNamed));
}

std::size_t ties_at_end(const std::vector<ErrorLine>& lines, const LineQuantity& quantity) {
  const std::set<double> xs = xs_of(lines);
  return xs.empty() ? 0 : best_at(lines, *xs.rbegin(), quantity).size();
}

std::string best_over(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                      const LineAxis& axis) {
  const std::set<double> xs = xs_of(lines);
  if (xs.empty()) return "";
  if (lines.size() == 1) return best_of_all(lines, quantity, axis);
  std::vector<std::vector<At>> best;
  for (const double x : xs) best.push_back(best_at(lines, x, quantity));
  // Those that tie with the best at each point, and lie far from it at none.
  const auto in_all = [](const std::vector<std::vector<At>>& points) {
    std::vector<At> some = points.front();
    for (const std::vector<At>& one : points)
      std::erase_if(some, [&](const At& at) {
        const auto here = std::ranges::find(one, at.line, &At::line);
        return here == one.end() || is_far_from(one.front(), *here);
      });
    return some;
  };
  const auto has_others = [&](const std::vector<At>& one) {
    return one.size() < known_at(lines, one.front().x()).size();
  };
  const auto finding = [&](const std::vector<At>& some) {
    return fmt::format(
        "{} {}", listed_names(some, lines),
        has_the_best(quantity, some.size() > 1 || is_plural(*some.front().line, quantity)));
  };
  // Lines that tie do not differ: the points are named at which the best is alone.
  const auto where_alone = [&](const std::vector<At>& some) {
    std::vector<double> alone;
    for (const std::vector<At>& one : best)
      if (are_alike(one, some) && has_others(one)) alone.push_back(one.front().x());
    if (alone.empty()) return std::string();
    const bool are_several = some.size() > 1 || is_plural(*some.front().line, quantity);
    return fmt::format("{} at {}; elsewhere {}", finding(some),
                       places(axis, alone, best.size(), quantity),
                       std::ranges::any_of(some, &At::is_tested)      ? kNotSignificant
                       : std::ranges::any_of(some, &At::has_interval) ? "intervals overlap"
                       : are_several                                  ? "they tie with others"
                                                                      : "it ties with others");
  };
  // Unless one of them is drawn below the best.
  const auto wherever_they_differ = [&](const std::vector<At>& some) {
    return is_beaten(some, lines, xs, quantity) ? where_alone(some)
                                                : finding(some) + " wherever they differ";
  };
  // Where all lines are equal, as without a disturbance, none is better.
  std::vector<std::vector<At>> differing = best;
  std::erase_if(differing, std::not_fn(has_others));
  if (differing.empty()) return "";
  const std::vector<At> throughout = in_all(best);
  if (!throughout.empty() && throughout.size() <= kMostNamed) {
    const auto alone = std::ranges::count_if(best, [&](const std::vector<At>& one) {
      return one.size() == throughout.size() && has_others(one);
    });
    if (alone == 0) {
      // A line that ties throughout may be drawn above others at most points.
      if (is_beaten(throughout, lines, xs, quantity)) {
        const std::string change = change_of_lead(best, lines, quantity, axis);
        return change.empty() ? most_frequent_lead(best, lines, quantity, axis) : change;
      }
      const bool several = throughout.size() > 1 || is_plural(*throughout.front().line, quantity);
      return fmt::format("{} {} for the {} {} throughout", listed_names(throughout, lines),
                         several ? "tie" : "ties", quantity.lower_is_better ? "lowest" : "highest",
                         quantity.label);
    }
    if (alone == std::ssize(best)) return finding(throughout) + " throughout";
    return alone == std::ssize(differing) ? wherever_they_differ(throughout)
                                          : where_alone(throughout);
  }
  if (const std::vector<At> some = in_all(differing); !some.empty() && some.size() <= kMostNamed)
    return wherever_they_differ(some);
  std::erase_if(differing, [](const std::vector<At>& one) { return one.size() > kMostNamed; });
  if (differing.empty()) return "";
  const std::vector<At>&first = differing.front(), &last = differing.back();
  if (are_alike(first, last)) {
    const double from = first.front().x(), to = last.front().x();
    const bool is_between = std::ranges::any_of(best, [&](const std::vector<At>& one) {
      const double x = one.front().x();
      return from < x && x < to &&
             std::ranges::any_of(first, [&](const At& at) { return has_line(one, at.line); });
    });
    // One point is left alone if at all others too many lines are equal to be named.
    const std::string where = from == to ? x_text(axis, from, quantity)
                                         : fmt::format("{} and {}", x_text(axis, from, quantity),
                                                       with_unit(data_number(to), axis.unit));
    return fmt::format("{} at {}, but not {}", finding(first), where,
                       is_between || from == to ? "throughout" : "between");
  }
  return fmt::format("{} at {}, {} at {}", finding(first),
                     x_text(axis, first.front().x(), quantity), listed_names(last, lines),
                     with_unit(data_number(last.front().x()), axis.unit));
}

std::string diverged_words(const std::vector<ErrorLine>& lines, const LineQuantity& quantity) {
  std::set<std::string> diverged, others;
  for (const At& at : all_known(lines))
    (quantity.has_diverged(at.mean()) ? diverged : others).insert(line_name(*at.line, lines));
  if (diverged.empty() || others.empty()) return "";
  const bool are_in_part =
      std::ranges::any_of(diverged, [&](const std::string& name) { return others.contains(name); });
  return fmt::format(
      "{} {}{}", diverged.size() == 1 ? *diverged.begin() : counted(std::ssize(diverged), "method"),
      kGreatErrorText, are_in_part ? " at some points" : "");
}

bool ends_tie(const ErrorLine& line) {
  const std::vector<ErrorLine> alone = {line};
  const std::vector<At> known = all_known(alone);
  return !known.empty() && overlap(known.front(), known.back());
}

bool intervals_overlap(const ErrorLine& line, std::size_t i, std::size_t k) {
  return overlap({&line, i}, {&line, k});
}

std::string best_of_all(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                        const LineAxis& axis) {
  const std::vector<At> known = all_known(lines);
  if (known.empty()) return "";
  const At best = best_in(known, quantity);
  if (lines.size() == 1)
    return fmt::format("the {} {} of {} is {} at {}",
                       quantity.lower_is_better ? "lowest" : "highest", quantity.label,
                       line_name(*best.line, lines), value_text(best.mean(), quantity),
                       x_text(axis, best.x(), quantity));
  // Tests are made of one point of each line.
  const auto is_judged = [&](const At& at) {
    const bool has_test = std::ranges::any_of(
        at.line->paired, [](PairedWithBest paired) { return paired != PairedWithBest::kUntested; });
    return at.is_tested() || !has_test || best.paired() != PairedWithBest::kBest;
  };
  const bool has_tie = std::ranges::any_of(known, [&](const At& at) {
    return at.line != best.line && is_judged(at) && tie(at, best, quantity);
  });
  if (has_tie) return "";
  return fmt::format("{} {}, {} at {}", line_name(*best.line, lines), has_the_best(quantity, false),
                     value_text(best.mean(), quantity), x_text(axis, best.x(), quantity));
}

std::string best_of_points(const std::vector<std::vector<ErrorLine>>& panels,
                           const LineQuantity& quantity) {
  std::map<std::string, int> wins;   // Beyond the intervals.
  std::map<std::string, int> leads;  // By the digits shown.
  std::vector<ErrorLine> all;
  int points = 0;
  double value = 0.0;
  bool are_tested = false;
  for (const std::vector<ErrorLine>& lines : panels) {
    for (const ErrorLine& line : lines)
      if (std::ranges::find(all, line.label, &ErrorLine::label) == all.end()) all.push_back(line);
    for (const double x : xs_of(lines)) {
      ++points;
      const std::vector<At> best = best_at(lines, x, quantity);
      const At& first = best.front();
      if (std::none_of(best.begin() + 1, best.end(),
                       [&](const At& other) { return are_shown_alike(other, first, quantity); }))
        ++leads[first.line->label];
      are_tested = are_tested || first.is_tested();
      if (best.size() > 1) continue;
      ++wins[first.line->label];
      value = first.mean();
    }
  }
  if (wins.empty()) return "";
  const auto most = std::ranges::max_element(wins, {}, &std::pair<const std::string, int>::second);
  if (std::ranges::count(wins, most->second, &std::pair<const std::string, int>::second) > 1)
    return "";
  if (2 * most->second <= points) return "";  // At most points another one, or several, are best.
  const auto& line = *std::ranges::find(all, most->first, &ErrorLine::label);
  const std::string best =
      fmt::format("{} {}", line_name(line, all), has_the_best(quantity, is_plural(line, quantity)));
  if (points == 1) return fmt::format("{}, {}", best, value_text(value, quantity));
  if (most->second == points) return best + " at all points";
  const int led = leads.at(most->first), overlapping = led - most->second;
  const std::string where = led == points ? fmt::format("all {} points", points)
                                          : fmt::format("{} of {} points", led, points);
  return fmt::format(
      "{} at {}{}", best, where,
      overlapping > 0 ? fmt::format("; {} at {}",
                                    are_tested ? kNotSignificant : "intervals overlap", overlapping)
                      : "");
}

}  // namespace mapproof
