#include "reports/history/shown_names.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/model/method.hpp"
#include "core/model/slam_study.hpp"

namespace mapproof {
namespace {

/// A setting without its variation's level.
std::string shown_setting(const std::string& setting) {
  if (const auto slam = slam_method_named(setting)) return std::string(info(*slam).label);
  const std::optional<Method> known = method_named(base_method(setting));
  if (!known) return setting;
  const std::string label(info(*known).label);
  const std::string_view name = info(*known).name;
  const auto& parameter = info(*known).parameter;
  if (!parameter || setting.size() <= name.size() + 1 + parameter->symbol.size()) return label;
  std::string value = setting.substr(name.size() + 1 + parameter->symbol.size());
  if (value.starts_with('-')) value.erase(0, 1);  // Of "sigma2-10": no parameter is below 0.
  return fmt::format("{}, {} = {}", label, parameter->shown, value);
}

}  // namespace

std::string base_method(const std::string& method) {
  std::string best;
  for (const MethodInfo& known : all_methods())
    if (method.starts_with(known.name) && known.name.size() > best.size() &&
        (method.size() == known.name.size() || method[known.name.size()] == '-'))
      best = known.name;
  return best.empty() ? method : best;
}

std::string shown_method(const std::string& method) {
  const std::size_t levels = levels_begin(method);
  const std::string shown = shown_setting(method.substr(0, levels));
  return levels == method.size() ? shown : shown + ", " + method.substr(levels + 1);
}

std::string shown_subject(const std::string& subject) {
  const std::size_t sensor = subject.find(", ");
  if (sensor == std::string::npos) return subject;
  const std::size_t method = sensor + 2;
  const std::size_t rest = std::min(subject.find(", ", method), subject.size());
  return subject.substr(0, method) + shown_method(subject.substr(method, rest - method)) +
         subject.substr(rest);
}

std::string shown_subject(const SeriesId& series) { return shown_subject(subject_of(series)); }

}  // namespace mapproof
