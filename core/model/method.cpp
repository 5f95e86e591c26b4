#include "core/model/method.hpp"

#include <array>
#include <vector>

#include <fmt/format.h>

#include "core/base/spelling.hpp"

namespace mapproof {
namespace {

constexpr ParameterInfo kNeighbours{.symbol = "K",
                                    .meaning = "number of nearest neighbours",
                                    .integer = true,
                                    .minimum = 1,
                                    .maximum = 1000};

constexpr std::array kMethods = {
    MethodInfo{.method = Method::kLpca,
               .name = "lpca",
               .label = "LPCA",
               .summary = "linear PCA of the observation vectors (classical scaling)",
               .source = "Torgerson 1952 [torgerson1952]",
               .parameter = std::nullopt},
    MethodInfo{.method = Method::kSmacof,
               .name = "smacof",
               .label = "SMACOF, equal weights",
               .summary = "least raw stress over all pairs, started from LPCA",
               .source = "de Leeuw 1977 [deleeuw1977]",
               .parameter = std::nullopt},
    MethodInfo{.method = Method::kSmacofKnn,
               .name = "smacof-knn",
               .label = "SMACOF, kNN weights",
               .summary = "least raw stress over neighbours alone, started from equal weights",
               .source = "de Leeuw 1977 [deleeuw1977]",
               .parameter = kNeighbours},
    MethodInfo{.method = Method::kIsomap,
               .name = "isomap",
               .label = "ISOMAP",
               .summary = "classical scaling of shortest paths in the kNN graph",
               .source = "Tenenbaum et al. 2000 [tenenbaum2000]",
               .parameter = kNeighbours},
};

}  // namespace

std::span<const MethodInfo> all_methods() { return kMethods; }

const MethodInfo& info(Method method) { return kMethods[static_cast<std::size_t>(method)]; }

std::optional<Method> method_named(std::string_view name) {
  for (const MethodInfo& candidate : kMethods)
    if (candidate.name == name) return candidate.method;
  return std::nullopt;
}

std::string_view nearest_method_name(std::string_view name) {
  std::vector<std::string_view> names;
  for (const MethodInfo& method : kMethods) names.push_back(method.name);
  return nearest_word(name, names);
}

std::string slug(const MethodSetting& setting) {
  const MethodInfo& method = info(setting.method);
  if (!setting.parameter || !method.parameter) return std::string(method.name);
  return fmt::format("{}-{}{:g}", method.name, method.parameter->symbol, *setting.parameter);
}

std::string label(const MethodSetting& setting) {
  const MethodInfo& method = info(setting.method);
  if (!setting.parameter || !method.parameter) return std::string(method.label);
  return fmt::format("{}, {} = {:g}", method.label, method.parameter->symbol, *setting.parameter);
}

}  // namespace mapproof
