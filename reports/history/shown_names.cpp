#include "reports/history/shown_names.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text/unit_text.hpp"
#include "core/model/method.hpp"
#include "core/model/slam/slam_study.hpp"

namespace mapproof {
namespace {

/// One of mapproof's settings without its variation's level.
std::string shown_setting(const std::string& setting) {
  if (const auto slam = slam_method_named(setting)) return std::string(info(*slam).label);
  const std::optional<Method> known = method_named(base_method({}, setting));
  if (!known) return setting;
  std::string label(info(*known).label);
  const std::string_view name = info(*known).name;
  const auto& parameter = info(*known).parameter;
  if (!parameter || setting.size() <= name.size() + 1 + parameter->symbol.size()) return label;
  std::string value = setting.substr(name.size() + 1 + parameter->symbol.size());
  if (value.starts_with('-')) value.erase(0, 1);  // Of "sigma2-10": no parameter is below 0.
  return fmt::format("{}, {} = {}", label, parameter->shown, value);
}

/// The size of the longest declared id that a SeriesId::method begins with; 0 if it is none.
std::size_t declared_size(const StudyLabels& labels, const std::string& method) {
  std::size_t size = 0;
  for (const auto& [id, label] : labels.methods)
    if (id.size() > size && method.starts_with(id) &&
        (method.size() == id.size() || method[id.size()] == ' '))
      size = id.size();
  return size;
}

/// The size of the id that a SeriesId::method begins with; its levels follow.
std::size_t id_size(const StudyLabels& labels, const std::string& method) {
  const std::size_t declared = declared_size(labels, method);
  return declared > 0 ? declared : levels_begin(method);
}

std::string label_in(const std::map<std::string, std::string>& labels, const std::string& id) {
  const auto found = labels.find(id);
  return found == labels.end() ? id : found->second;
}

}  // namespace

std::string base_method(const StudyLabels& labels, const std::string& method) {
  if (const std::size_t size = declared_size(labels, method); size > 0)
    return method.substr(0, size);
  std::string best;
  for (const MethodInfo& known : all_methods())
    if (method.starts_with(known.name) && known.name.size() > best.size() &&
        (method.size() == known.name.size() || method[known.name.size()] == '-'))
      best = known.name;
  return best.empty() ? method : best;
}

std::string shown_setup(const StudyLabels& labels, const std::string& setup) {
  return label_in(labels.setups, setup);
}

std::vector<ShownLevel> levels_of(const StudyLabels& labels, const std::string& method) {
  constexpr std::string_view kOf = " of ";
  std::vector<ShownLevel> levels;
  for (std::size_t at = id_size(labels, method); at < method.size();) {
    const std::size_t is = method.find('=', at);
    if (is == std::string::npos || method[at] != ' ') break;
    const std::string id = method.substr(at + 1, is - at - 1);
    // A value may hold blanks: the next level begins at the last one before its "=".
    const std::size_t next = method.find('=', is + 1);
    const std::size_t end = next == std::string::npos ? method.size() : method.rfind(' ', next);
    std::string value = method.substr(is + 1, end - is - 1);
    value.resize(std::min(value.find(kOf), value.size()));
    const auto known = labels.factors.find(id);
    const bool has_label = known != labels.factors.end() && !known->second.label.empty();
    levels.push_back({has_label ? known->second.label : id, value,
                      known == labels.factors.end() ? "" : known->second.unit});
    at = end;
  }
  return levels;
}

std::string shown_method(const StudyLabels& labels, const std::string& method) {
  const std::size_t declared = declared_size(labels, method), size = id_size(labels, method);
  const std::string id = method.substr(0, size), rest = method.substr(size);
  // A study of results labels its setups; what it does not declare is not a method of mapproof.
  const bool is_of_mapproof = labels.methods.empty() || labels.setups.empty();
  std::string shown = declared > 0     ? labels.methods.at(id)
                      : is_of_mapproof ? shown_setting(id)
                                       : id;
  for (const ShownLevel& level : levels_of(labels, method)) shown += ", " + level.words();
  // Whom it is of.
  const std::size_t of = rest.find(" of ");
  return of == std::string::npos ? shown : shown + rest.substr(of);
}

std::string ShownLevel::words() const { return name + " " + with_unit(value, unit); }

std::string shown_method_of(const StudyLabels& labels, const SeriesId& series) {
  const std::string setup = shown_setup(labels, series.sensor);
  return (setup.empty() ? "" : setup + ", ") + shown_method(labels, series.method);
}

std::string shown_subject(const StudyLabels& labels, const SeriesId& series) {
  return shown_method_of(labels, series) +
         (series.step == 0 ? "" : fmt::format(", {} steps", series.step));
}

}  // namespace mapproof
