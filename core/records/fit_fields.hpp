#pragma once

#include "core/model/fit.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

// The fields of a fit in map.json, slam.json and runs/ID.json (core/json/fields.hpp).

inline EnumNames enum_names(FitVerdict) {
  return names_up_to(FitVerdict::kNotTestable, "fit_verdict");
}
inline EnumNames enum_names(FitCode) { return names_up_to(FitCode::kDisconnected, "fit_code"); }
inline EnumNames enum_names(FitMissing) { return names_up_to(FitMissing::kSize, "fit_missing"); }

namespace record_rules {

inline constexpr FieldRule kFitNames = {.description = "Names of landmarks; none: all.",
                                        .max_items = kMostLandmarks,
                                        .not_empty = true,
                                        .max_bytes = kLongestName};

}  // namespace record_rules

template <typename Visitor>
void fields(Visitor& v, FitValue& value) {
  v.type("fit_value");
  v.field("id", value.id,
          {.description = "With its unit: offset_m, from_s.", .not_empty = true, .max_bytes = 100});
  v.field("value", value.value, {.nullable = true});
  v.field("sigma", value.sigma, {.description = "Standard deviation.", .key = Key::kIfAny});
}

template <typename Visitor>
void fields(Visitor& v, FitTest& test) {
  v.type("fit_test");
  v.field("code", test.code);
  v.field("landmarks", test.landmarks, record_rules::kFitNames);
  v.field("statistic", test.statistic, {.nullable = true});
  v.field("bound", test.bound, {.minimum = 0.0, .above_minimum = true});
  v.field("limit", test.limit,
          {.description = "The least effect that would have been seen in these data.",
           .key = Key::kIfAny});
}

template <typename Visitor>
void fields(Visitor& v, FitCause& cause) {
  v.type("fit_cause");
  v.field("code", cause.code);
  v.field("landmarks", cause.landmarks, record_rules::kFitNames);
  v.field("values", cause.values, {.max_items = 100});
  v.field("statistic", cause.statistic, {.nullable = true});
  v.field("bound", cause.bound, {.minimum = 0.0, .above_minimum = true});
  v.field("small", cause.is_small,
          {.description = "Significant, but the map hardly depends on it."});
  v.field("figure", cause.figure,
          {.description = "Id of the figure that shows why; empty: none.", .max_bytes = 120});
}

template <typename Visitor>
void fields(Visitor& v, FitNumber& number) {
  v.type("fit_number");
  v.field("quantity", number.quantity, {.not_empty = true, .max_bytes = 100});
  v.field("value", number.value, {.nullable = true});
  v.field("bound", number.bound,
          {.description = "Above which it is an alarm.", .key = Key::kIfAny});
}

template <typename Visitor>
void fields(Visitor& v, FittedRange& range) {
  v.type("fitted_range");
  v.field("time_s", range.time_s, {.whole_as_integers = true});
  v.field("landmark", range.landmark, {.minimum = 0, .maximum = kMostLandmarks - 1});
  v.field("range_m", range.range_m, {.whole_as_integers = true});
  v.field("normalised", range.normalised, {.nullable = true, .whole_as_integers = true});
  v.field("inlier", range.inlier, {.minimum = 0.0, .maximum = 1.0, .whole_as_integers = true});
}

template <typename Visitor>
void fields(Visitor& v, Fit& fit) {
  v.type("fit");
  v.about("Whether the data fit the map, from the data alone, and why not.");
  v.field("verdict", fit.verdict);
  v.field("causes", fit.causes, {.max_items = 1000});
  static constexpr FieldRule kGroup = record_rules::kFitNames;
  v.field("parts", fit.parts,
          {.description = "Groups of landmarks whose position relative to each other is open.",
           .max_items = kMostLandmarks,
           .items = &kGroup});
  v.field("why", fit.why,
          {.description = "What is missing for a test; only if the verdict is not_testable.",
           .max_items = 10});
  v.field("numbers", fit.numbers, {.max_items = 100});
  v.field("tests", fit.tests, {.description = "All tests that were made.", .max_items = 10'000});
  if (fit.verdict != FitVerdict::kNotTestable && !fit.why.empty())
    v.refuse("why", "is of the verdict not_testable alone");
}

}  // namespace mapproof
