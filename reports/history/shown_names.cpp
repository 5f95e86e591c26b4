#include "reports/history/shown_names.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace mapproof {
namespace {

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

/// What follows the id: " noise=0.1 pace=2" and " of robot 2".
struct Tail {
  std::string levels, subject;
};

Tail tail_of(const StudyLabels& labels, const std::string& method) {
  const std::string rest = method.substr(id_size(labels, method));
  const std::size_t of = std::min(rest.find(" of "), rest.size());
  return {rest.substr(0, of), rest.substr(of)};
}

/// Where a level ends whose "=" is at `is`: at the last blank before the next "=" with one between.
std::size_t level_end(const std::string& levels, std::size_t is) {
  for (std::size_t next = levels.find('=', is + 1); next != std::string::npos;
       next = levels.find('=', next + 1))
    if (const std::size_t blank = levels.rfind(' ', next); blank != std::string::npos && blank > is)
      return blank;
  return levels.size();
}

std::string label_in(const std::map<std::string, std::string>& labels, const std::string& id) {
  const auto found = labels.find(id);
  return found == labels.end() ? id : found->second;
}

}  // namespace

std::string base_method(const StudyLabels& labels, const std::string& method) {
  if (const std::size_t size = declared_size(labels, method); size > 0)
    return method.substr(0, size);
  const std::string found = method_in_setting(method);
  return found.empty() ? method : found;
}

std::string shown_setup(const StudyLabels& labels, const std::string& setup) {
  return label_in(labels.setups, setup);
}

std::vector<ShownLevel> levels_of(const StudyLabels& labels, const std::string& method) {
  const std::string text = tail_of(labels, method).levels;
  std::vector<ShownLevel> levels;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t is = text.find('=', at);
    if (is == std::string::npos) break;
    const std::size_t end = level_end(text, is);
    levels.push_back(
        shown_level(labels, text.substr(at + 1, is - at - 1), text.substr(is + 1, end - is - 1)));
    at = end;
  }
  return levels;
}

std::string shown_method(const StudyLabels& labels, const std::string& method) {
  const std::size_t declared = declared_size(labels, method);
  const std::string id = method.substr(0, id_size(labels, method));
  // A study of results labels its setups; what it does not declare is not a method of mapproof.
  const bool is_of_mapproof = labels.methods.empty() || labels.setups.empty();
  std::string shown = declared > 0 ? labels.methods.at(id) : is_of_mapproof ? setting_text(id) : id;
  const Tail tail = tail_of(labels, method);
  const std::vector<ShownLevel> levels = levels_of(labels, method);
  if (levels.empty() && !tail.levels.empty()) shown += ", " + tail.levels.substr(1);
  for (const ShownLevel& level : levels) shown += ", " + level.words();
  return shown + tail.subject;
}

std::string shown_method_of(const StudyLabels& labels, const SeriesId& series) {
  const std::string setup = shown_setup(labels, series.sensor);
  return (setup.empty() ? "" : setup + ", ") + shown_method(labels, series.method);
}

std::string shown_subject(const StudyLabels& labels, const SeriesId& series) {
  return shown_method_of(labels, series) +
         (series.step == 0 ? "" : fmt::format(", {} steps", series.step));
}

}  // namespace mapproof
