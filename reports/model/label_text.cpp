#include "reports/model/label_text.hpp"

#include <string_view>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/json/text_input.hpp"
#include "core/model/method.hpp"
#include "core/model/slam/slam_method.hpp"

namespace mapproof {

std::string method_in_setting(const std::string& setting) {
  std::string best;
  for (const MethodInfo& known : all_methods())
    if (setting.starts_with(known.name) && known.name.size() > best.size() &&
        (setting.size() == known.name.size() || setting[known.name.size()] == '-'))
      best = known.name;
  return best;
}

std::string setting_text(const std::string& setting) {
  if (const auto slam = slam_method_named(setting)) return std::string(info(*slam).label);
  const std::optional<Method> known = method_named(method_in_setting(setting));
  if (!known) return setting;
  std::string label(info(*known).label);
  const std::string_view name = info(*known).name;
  const auto& parameter = info(*known).parameter;
  if (!parameter || setting.size() <= name.size() + 1 + parameter->symbol.size()) return label;
  std::string value = setting.substr(name.size() + 1 + parameter->symbol.size());
  if (value.starts_with('-')) value.erase(0, 1);  // Of "sigma2-10": no parameter is below 0.
  return fmt::format("{}, {} = {}", label, parameter->shown, value);
}

std::string method_text(const StudyLabels& labels, const std::string& method) {
  const auto declared = labels.methods.find(method);
  return declared == labels.methods.end() ? setting_text(method) : declared->second;
}

std::string ShownLevel::words() const { return name + " " + with_unit(value, unit); }

ShownLevel shown_level(const StudyLabels& labels, const std::string& factor,
                       const std::string& value) {
  const auto known = labels.factors.find(factor);
  const LabelWithUnit label = known == labels.factors.end() ? LabelWithUnit{} : known->second;
  const std::optional<double> number = number_in(value);
  return {label.label.empty() ? factor : label.label, number ? level_number_text(*number) : value,
          label.unit, number};
}

}  // namespace mapproof
