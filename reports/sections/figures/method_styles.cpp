#include "reports/sections/figures/method_styles.hpp"

#include <vector>

#include <fmt/format.h>

#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/method_series.hpp"

namespace mapproof {

std::size_t series_of_method(const Experiment& experiment, Method method) {
  const ExternalMethod* external = find_external(experiment, method);
  if (external == nullptr) return method_series(method);
  std::vector<std::size_t> own;
  for (const SensorStudy& sensor : experiment.sensors)
    for (const MethodGrid& grid : sensor.methods)
      if (find_external(experiment, grid.method) == nullptr)
        own.push_back(method_series(grid.method));
  const auto k = static_cast<std::size_t>(external - experiment.external_methods.data());
  return own.empty() ? kMethodStyles + k : free_series(own, k + 1, kMethodStyles)[k];
}

namespace {

std::string with_hard_spaces(const std::string& text) {
  std::string hard;
  for (const char c : text) hard += c == ' ' ? "\u00A0" : std::string(1, c);
  return hard;
}

}  // namespace

std::string short_label(const MethodSetting& setting) {
  // Not to be broken: what is above a small panel takes two lines.
  const std::string parameter = with_hard_spaces(parameter_text(setting));
  const auto with = [&](std::string_view method) {
    return parameter.empty() ? std::string(method) : fmt::format("{}, {}", method, parameter);
  };
  switch (setting.method) {
    case Method::kSmacof:
      return with("SMACOF");
    case Method::kSmacofKnn:
      return with("SMACOF kNN");
    case Method::kKpcaGaussian:
      return with("KPCA Gauss");
    case Method::kKpcaPolynomial:
      return with("KPCA poly");
    case Method::kLandmarkIsomap:
      return with("L-ISOMAP");
    case Method::kLandmarkMvu:
      return with("L-MVU");
    default:
      return with(info(setting.method).label);
  }
}

}  // namespace mapproof
