#pragma once

#include <algorithm>
#include <concepts>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/json/fields.hpp"
#include "core/json/text_input.hpp"
#include "core/model/study.hpp"
#include "core/records/limits.hpp"
#include "core/records/text_forms.hpp"

namespace mapproof {

// The fields of the values that several files hold (core/json/fields.hpp), and what enumerators are
// called in files.

inline EnumNames enum_names(Sensor) { return names_up_to(Sensor::kRange, "sensor"); }
inline EnumNames enum_names(StatusCode) { return names_up_to(StatusCode::kFailed, "status"); }
inline EnumNames enum_names(StatusReason) { return names_up_to(StatusReason::kMessage, "reason"); }
inline EnumNames enum_names(SdpSolver) { return names_up_to(SdpSolver::kCsdp, "solver"); }
inline EnumNames enum_names(Frame) { return names_up_to(Frame::kSimilarity, "frame"); }

inline EnumNames enum_names(Method) {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const MethodInfo& method : all_methods()) all.push_back(method.name);
    return all;
  }();
  return {"method", names};
}

namespace record_rules {

inline constexpr std::size_t kMostRecords = 1'000'000;

inline constexpr FieldRule kStep = {
    .description = "Number of observations used.", .minimum = 0, .maximum = kMostSteps};
inline constexpr FieldRule kCount = {.minimum = 0, .maximum = std::numeric_limits<int>::max()};
inline constexpr FieldRule kLength = {.minimum = 0.0, .nullable = true};
inline constexpr FieldRule kPercent = {.minimum = 0.0, .maximum = 100.0, .nullable = true};
inline constexpr FieldRule kPositions = {
    .description = "One row per landmark: [x, y], or null where there is no position.",
    .nullable = true,
    .max_items = kMostLandmarks};
inline constexpr FieldRule kRows = {.description = "Rows of landmarks, counted from 0.",
                                    .minimum = 0,
                                    .maximum = kMostLandmarks - 1,
                                    .unique = true,
                                    .max_items = kMostLandmarks};
inline constexpr FieldRule kNames = {
    .unique = true, .max_items = kMostLandmarks, .not_empty = true, .max_bytes = kLongestName};
inline constexpr FieldRule kStatuses = {.description = "Warnings and failures.", .max_items = 1000};

}  // namespace record_rules

/// Refuses rows of `size` landmarks that are not there.
template <typename Visitor>
void check_rows(Visitor& v, std::string_view key, const std::vector<Eigen::Index>& rows,
                Eigen::Index size) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] < 0 || rows[i] >= size)
      v.refuse(key, i, fmt::format("expected an integer from 0 to {}, got {}", size - 1, rows[i]));
}

/// Refuses an id that stood there before, of the records at a key.
template <typename Visitor, typename Record>
void check_ids(Visitor& v, std::string_view key, const std::vector<Record>& records) {
  if constexpr (Visitor::kReads) {
    std::set<std::string_view> ids;
    for (std::size_t i = 0; i < records.size(); ++i)
      if (!ids.insert(records[i].id).second)
        v.refuse(fmt::format("{}/{}/id", key, i), "is there twice");
  }
}

/// Refuses a number that is more than another field allows.
template <typename Visitor, typename Number>
void check_at_most(Visitor& v, std::string_view key, Number number, Number least, Number most) {
  constexpr std::string_view kExpected = std::integral<Number> ? "an integer" : "a number";
  if (number > most)
    v.refuse(key, fmt::format("expected {} from {} to {}, got {}", kExpected, least, most, number));
}

template <typename Visitor>
void fields(Visitor& v, RunId& run) {
  v.type("run");
  v.field("layout", run.layout, {.minimum = 1, .maximum = kMostLayouts});
  v.field("pose", run.pose, {.minimum = 1, .maximum = kMostPoses});
}

/// A method of Status::starts: a map's own method may be pairs, too (map_fields.hpp).
enum class StartMethod {};
inline EnumNames enum_names(StartMethod) { return {"start", enum_names(Method()).names}; }

template <typename Visitor>
void fields(Visitor& v, SubmapCount& submaps) {
  v.type("submap_count");
  v.about("How many sub-maps ended so, of all.");
  v.field("count", submaps.count, record_rules::kCount);
  v.field("submaps", submaps.submaps, record_rules::kCount);
}

/// What is wrong with so many names; empty if nothing is.
inline std::string names_problem(StatusNames rule, std::size_t names) {
  switch (rule) {
    case StatusNames::kNone:
      return names == 0 ? "" : "expected no names";
    case StatusNames::kOne:
      return names == 1 ? "" : "expected one name";
    case StatusNames::kSome:
      return names > 0 ? "" : "expected names";
    case StatusNames::kIfKnown:
      break;
  }
  return "";
}

template <typename Visitor>
void fields(Visitor& v, Status& status) {
  v.type("warning");
  v.field("code", status.code);
  v.field("reason", status.reason, {.description = "Why, as docs/methods/warnings.md has it."});
  v.field("values", status.values,
          {.nullable = true,
           .null_is = kInfinity,
           .whole_as_integers = true,
           .max_items = 100,
           .key = Key::kIfAny});
  v.field("names", status.names,
          {.description = "Of landmarks; of a message the message.",
           .max_items = kMostLandmarks,
           .max_bytes = kLongestText,
           .key = Key::kIfAny});
  std::vector<StartMethod> starts;
  for (const Method method : status.starts) starts.push_back(static_cast<StartMethod>(method));
  v.field("starts", starts,
          {.description = "Methods: of the map that the map started from, or of that one's.",
           .max_items = 10,
           .key = Key::kIfAny});
  if constexpr (Visitor::kReads) {
    status.starts.clear();
    for (const StartMethod method : starts) status.starts.push_back(static_cast<Method>(method));
  }
  v.field("submaps", status.submaps, {.key = Key::kIfAny});
  const StatusReasonInfo& reason = info(status.reason);
  if (status.values.size() != reason.value_count())
    v.refuse("values", fmt::format("expected {} of {}, got {}",
                                   counted(static_cast<long long>(reason.value_count()), "value"),
                                   reason.name, status.values.size()));
  if (const std::string wrong = names_problem(reason.names, status.names.size()); !wrong.empty())
    v.refuse("names", wrong);
}

template <typename Visitor>
void fields(Visitor& v, Score& score) {
  using namespace record_rules;
  v.type("score");
  v.field("mpe_m", score.mpe_m, kLength);
  v.field("moe_percent", score.moe_percent, kPercent);
  v.field("mpe_all_fitted_m", score.mpe_all_fitted_m, kLength);
  v.field("moe_unmirrored_percent", score.moe_unmirrored_percent, kPercent);
}

template <typename Visitor>
void fields(Visitor& v, Certificate& certificate) {
  v.type("certificate");
  v.about(
      "Of a method that is a semidefinite program: how near its optimum. A dual below 0: there "
      "is not a feasible point; null: nothing was certified.");
  v.field("solver", certificate.solver);
  v.field("primal", certificate.primal, {.minimum = 0.0});
  v.field("dual", certificate.dual, {.nullable = true, .null_is = kInfinity});
  v.field("relative_gap", certificate.relative_gap,
          {.minimum = 0.0, .nullable = true, .null_is = kInfinity});
  v.field("constraint_residual", certificate.constraint_residual, {.minimum = 0.0});
}

/// Of all methods, each symbol once.
inline const std::vector<ParameterInfo>& method_parameters() {
  static const std::vector<ParameterInfo> parameters = [] {
    std::vector<ParameterInfo> all;
    for (const MethodInfo& method : all_methods())
      if (method.parameter &&
          std::ranges::find(all, method.parameter->symbol, &ParameterInfo::symbol) == all.end())
        all.push_back(*method.parameter);
    return all;
  }();
  return parameters;
}

/// The parameters that a method may have, of which `own` has to be there.
template <typename Visitor>
void parameter_fields(Visitor& v, const std::optional<ParameterInfo>& own,
                      std::optional<double>& value) {
  for (const ParameterInfo& parameter : method_parameters())
    v.field(parameter.symbol, value,
            {.description = parameter.meaning,
             .minimum = parameter.minimum,
             .maximum = parameter.maximum,
             .whole_as_integers = true,
             .integer = parameter.integer,
             .key = Key::kNotNull,
             .when = own && own->symbol == parameter.symbol});
}

/// A method of mapproof and the value of its parameter, if it has one: keys of the object that they
/// describe.
template <typename Visitor>
void setting_fields(Visitor& v, MethodSetting& setting) {
  v.field("method", setting.method, {.description = "The mapping method.", .decides = true});
  parameter_fields(v, info(setting.method).parameter, setting.parameter);
}

template <typename Visitor>
void fields(Visitor& v, ExternalMethodInfo& method) {
  v.type("external");
  v.about("A method of others, beside its name.");
  v.field("label", method.label, {.not_empty = true, .max_bytes = 200});
  v.field("source", method.source, {.max_bytes = 1000, .key = Key::kIfAny});
  v.field("symbol", method.symbol,
          {.description = "Of its parameter.", .max_bytes = 60, .key = Key::kIfAny});
}

/// The rest of a method's keys, behind "method", which decides: its parameter, and of a method of
/// others what describes it.
/// @param method   The value of "method".
/// @param is_ours  Whether it is a method of mapproof, of which `setting` has the parameter.
/// @param setting  Is filled in by a reader, if `method` is a method.
template <typename Visitor>
void method_fields(Visitor& v, const std::string& method, bool is_ours, MethodSetting& setting) {
  const std::optional<Method> known = method_named(method);
  std::optional<ExternalMethodInfo> external = description_of_external(setting.method);
  v.field("external", external, {.key = Key::kIfAny, .when = !is_ours});
  parameter_fields(v, known ? info(*known).parameter : std::nullopt, setting.parameter);
  v.field("parameter", setting.parameter,
          {.description = "Of a method of others.",
           .whole_as_integers = true,
           .key = Key::kIfAny,
           .when = !is_ours});
  if constexpr (Visitor::kReads) {
    if (known) setting.method = *known;
    if (is_ours) return;
    if (!external)
      return v.refuse("method", fmt::format("unknown method {}: did you mean \"{}\"?",
                                            in_quotes(method), nearest_method_name(method)));
    if (external->symbol.empty() == setting.parameter.has_value())
      v.refuse("external", external->symbol.empty()
                               ? "has no symbol of the parameter"
                               : "has the symbol of a parameter, which is missing");
    external->name = method;
    setting.method = external_method(*external);
  }
}

/// A method of mapproof or of others, and the value of its parameter.
template <typename Visitor>
void any_setting_fields(Visitor& v, MethodSetting& setting) {
  std::string method(info(setting.method).name);
  v.field("method", method,
          {.description = "A method of mapproof; one of others is described by external.",
           .max_bytes = 60,
           .form = &kPlainId,
           .decides = true,
           .known = enum_names(Method{}).names});
  method_fields(v, method, method_named(method).has_value(), setting);
}

/// An element of Provenance::libraries.
struct LibraryVersion {
  std::string name, version;
};

template <typename Visitor>
void fields(Visitor& v, LibraryVersion& library) {
  v.field("name", library.name);
  v.field("version", library.version);
}

template <typename Visitor>
void fields(Visitor& v, MethodFiles& files) {
  v.field("method", files.method, {.max_bytes = 60, .form = &kPlainId});
  v.field("sha256", files.sha256, {.max_bytes = 64});
}

template <typename Visitor>
void fields(Visitor& v, Provenance& provenance) {
  v.type("provenance");
  v.field("version", provenance.version, {.description = "Of mapproof."});
  v.field("commit", provenance.commit, {.description = "Of its source."});
  v.field("solver_digest", provenance.solver_digest,
          {.description = "SHA-256 of the sources of core that compute."});
  std::vector<LibraryVersion> libraries;
  for (const auto& [name, version] : provenance.libraries) libraries.push_back({name, version});
  v.field("libraries", libraries, {.max_items = 1000});
  v.field("method_files", provenance.method_files,
          {.description = "Of methods of others: the SHA-256 of the files that they are made of.",
           .max_items = 100,
           .key = Key::kIfAny});
  if constexpr (Visitor::kReads)
    for (LibraryVersion& library : libraries)
      provenance.libraries.emplace_back(std::move(library.name), std::move(library.version));
}

}  // namespace mapproof
