#include "reports/sections/figures/method_styles.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace mapproof {

std::size_t series_of_method(const Experiment& experiment, Method method) {
  // There are seven colours: the last three methods take those of the first three, with other
  // dashes and markers. No two methods of one figure of the paper share a colour.
  constexpr std::array kOrder = {
      Method::kLpca,
      Method::kSde,
      Method::kIsomap,
      Method::kLle,
      Method::kSmacof,
      Method::kSmacofKnn,
      Method::kLaplacianEigenmap,
      Method::kHessianLle,
      Method::kKpcaGaussian,
      Method::kKpcaPolynomial,
  };
  const auto ours = std::ranges::find(kOrder, method);
  const auto series = static_cast<std::size_t>(ours - kOrder.begin());
  const ExternalMethod* external = find_external(experiment, method);
  if (external == nullptr) return series;
  return series + static_cast<std::size_t>(external - experiment.external_methods.data());
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
    default:
      return with(info(setting.method).label);
  }
}

}  // namespace mapproof
