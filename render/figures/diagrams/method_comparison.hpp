#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// A method's error, ours and as published.
struct PublishedError {
  std::string label;              ///< "SMACOF, kNN weights".
  std::string key;                ///< [a-z0-9-]+, unique in the panel.
  double mean_m = 0.0;            ///< Ours, > 0; others are left out.
  std::optional<Range> interval = {};  ///< 95 % interval of our mean [m].
  std::optional<double> published_m = {};
  bool can_compare = true;  ///< False: the published error is of another map, and is not counted.
};

/// How published errors lie to our 95 % intervals.
struct PublishedAgreement {
  int compared = 0;      ///< Methods with an interval and a published error that can be compared.
  int within = 0;        ///< Of them, those with the published error inside the interval.
  int ours_smaller = 0;  ///< Of the others, those with the interval below the published error.
  int apart = 0;         ///< Methods whose published error cannot be compared.

  PublishedAgreement& operator+=(const PublishedAgreement& other);
};

PublishedAgreement agreement_of(std::span<const PublishedError> methods);

struct PublishedErrorsSpec {
  struct Sensor {
    std::string title;   ///< "Visibility maps".
    std::string source;  ///< "Yairi 2007, Table 1".
    std::vector<PublishedError> methods;
  };
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::vector<Sensor> sensors;
  std::vector<std::string> record_ids;
};

/// A panel per sensor: each method's mean error with its interval, and the published one, on a
/// logarithmic axis, least error uppermost. The title counts the published errors within our
/// intervals; those that cannot be compared are grey and not counted.
Figure published_errors_figure(const PublishedErrorsSpec& spec);

struct RankedMethod {
  std::string label;
  double mean_rank = 1.0;  ///< 1 is best.
};

struct CriticalDifferenceSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::vector<RankedMethod> methods;  ///< In any order.
  double critical_difference = 0.0;   ///< Of mean ranks, Nemenyi's [nemenyi1963].
  double alpha = 0.0;
  int units = 0;  ///< That the methods were ranked on.
  std::string unit = "layout";
  double friedman_p = 1.0;  ///< Of no difference at all.
  std::vector<std::string> record_ids;
};

/// The critical-difference diagram [demsar2006, fig. 1]: methods at their mean ranks, the best to
/// the left; thick bars join those that do not differ. An arrow stands for a critical
/// difference longer than the axis, with a note.
/// @throws InvalidInput unless ranks are finite and in 1 to the number of methods, the critical
///         difference is positive and there are at most 30 methods.
Figure critical_difference_figure(const CriticalDifferenceSpec& spec);

/// What such a diagram shows, as a title: "SDE ranks best by MPE; 6 of 9 others rank significantly
/// lower". @param by  What the methods are ranked by.
std::string ranking_title(const CriticalDifferenceSpec& spec, const std::string& by);

/// What a setting of a method costs and how far its maps are off.
struct CostedSetting {
  std::string label;
  double seconds = 0.0;  ///< A map, > 0.
  double mpe_m = 0.0;
};

struct ParetoSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string y_label = "MPE [m]";
  std::vector<CostedSetting> settings;  ///< Those with a NaN or without cost are left out.
  std::vector<std::string> untimed;     ///< Labels of settings that a note names, as not shown.
  std::vector<std::string> record_ids;
};

/// The settings that no other beats in both, by ascending seconds: indices. Of equal ones the
/// first; of those whose maps diverged none, unless all did.
std::vector<std::size_t> pareto_front(const std::vector<CostedSetting>& settings);

/// Error against the time per map, a point per setting, those on the front filled, named and
/// joined; of those whose maps diverged see curves/diverged.hpp. Times differ from run to run: the
/// figure is marked so.
/// @throws InvalidInput if a value is infinite or negative.
Figure pareto_figure(const ParetoSpec& spec);

}  // namespace mapproof
