#include "core/model/method.hpp"

#include <array>
#include <cstdlib>
#include <deque>
#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/raised.hpp"
#include "core/base/text/spelling.hpp"

namespace mapproof {
namespace {

constexpr ParameterInfo kNeighbours{.symbol = "K",
                                    .shown = "K",
                                    .meaning = "number of nearest neighbours",
                                    .integer = true,
                                    .minimum = 1,
                                    .maximum = 1000,
                                    .counts_neighbours = true};

constexpr ParameterInfo kHessianNeighbours{.symbol = "K",
                                           .shown = "K",
                                           .meaning =
                                               "number of nearest neighbours; no map below "
                                               "6",
                                           .integer = true,
                                           .minimum = 1,
                                           .maximum = 1000,
                                           .counts_neighbours = true};

constexpr ParameterInfo kKernelVariance{.symbol = "sigma2",
                                        .shown = "σ²",
                                        .meaning =
                                            "variance of the Gaussian kernel, in units of "
                                            "squared distance",
                                        .integer = false,
                                        .minimum = 1e-9,
                                        .maximum = 1e12};

constexpr ParameterInfo kDegree{.symbol = "d",
                                .shown = "d",
                                .meaning = "degree of the polynomial kernel",
                                .integer = true,
                                .minimum = 1,
                                .maximum = 20};

constexpr std::array kMappingMethods = {
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
               .parameter = std::nullopt,
               .starts_from = Method::kLpca},
    MethodInfo{.method = Method::kSmacofKnn,
               .name = "smacof-knn",
               .label = "SMACOF, kNN weights",
               .summary = "least raw stress over neighbours alone, started from equal weights",
               .source = "de Leeuw 1977 [deleeuw1977]",
               .parameter = kNeighbours,
               .starts_from = Method::kSmacof},
    MethodInfo{.method = Method::kKpcaGaussian,
               .name = "kpca-gaussian",
               .label = "KPCA, Gaussian",
               .summary = "kernel PCA with k(a, b) = exp(-|a - b|² / 2σ²)",
               .source = "Schölkopf et al. 1998 [schoelkopf1998]",
               .parameter = kKernelVariance},
    MethodInfo{.method = Method::kKpcaPolynomial,
               .name = "kpca-polynomial",
               .label = "KPCA, polynomial",
               .summary = "kernel PCA with k(a, b) = (a·b + 1)^d",
               .source = "Schölkopf et al. 1998 [schoelkopf1998]",
               .parameter = kDegree},
    MethodInfo{.method = Method::kIsomap,
               .name = "isomap",
               .label = "ISOMAP",
               .summary = "classical scaling of shortest paths in the kNN graph",
               .source = "Tenenbaum et al. 2000 [tenenbaum2000]",
               .parameter = kNeighbours},
    MethodInfo{.method = Method::kLle,
               .name = "lle",
               .label = "LLE",
               .summary = "each landmark the same blend of its K neighbours in map and data",
               .source = "Roweis and Saul 2000 [roweis2000]",
               .parameter = kNeighbours},
    MethodInfo{.method = Method::kLaplacianEigenmap,
               .name = "lem",
               .label = "LEM",
               .summary = "eigenvectors of the kNN graph's Laplacian, all weights one",
               .source = "Belkin and Niyogi 2003 [belkin2003]",
               .parameter = kNeighbours},
    MethodInfo{.method = Method::kHessianLle,
               .name = "hlle",
               .label = "HLLE",
               .summary = "functions of least curvature over neighbourhoods of K",
               .source = "Donoho and Grimes 2003 [donoho2003]",
               .parameter = kHessianNeighbours},
    MethodInfo{.method = Method::kSde,
               .name = "sde",
               .label = "SDE",
               .summary = "greatest variance that keeps the distances in neighbourhoods",
               .source = "Weinberger and Saul 2004 [weinberger2004]",
               .parameter = kNeighbours},
    MethodInfo{.method = Method::kLandmarkIsomap,
               .name = "landmark-isomap",
               .label = "Landmark ISOMAP",
               .summary = "ISOMAP by the shortest paths to a part of the landmarks alone",
               .source = "de Silva and Tenenbaum 2003 [silva2003]",
               .parameter = kNeighbours,
               .approximates = Method::kIsomap},
    MethodInfo{.method = Method::kLandmarkMvu,
               .name = "landmark-mvu",
               .label = "Landmark MVU",
               .summary = "SDE of a part of the landmarks, which blend all others",
               .source = "Weinberger, Packer and Saul 2005 [weinberger2005]",
               .parameter = kNeighbours,
               .approximates = Method::kSde},
};

/// The methods of others that the program has met. It grows alone, so that references stay valid.
class ExternalTable {
 public:
  Method intern(const ExternalMethodInfo& description) {
    const std::lock_guard lock(mutex_);
    const auto method = static_cast<Method>(kMappingMethods.size() + infos_.size());
    const auto [known, is_new] = methods_.emplace(description, method);
    if (is_new) infos_.push_back(info_of(known->first, method));
    return known->second;
  }

  const MethodInfo& info(Method method) {
    const std::lock_guard lock(mutex_);
    return infos_.at(static_cast<std::size_t>(method) - kMappingMethods.size());
  }

 private:
  /// @param description  Outlives the result.
  static MethodInfo info_of(const ExternalMethodInfo& description, Method method) {
    MethodInfo info{.method = method,
                    .name = description.name,
                    .label = description.label,
                    .summary = "method of others",
                    .source = description.source,
                    .parameter = std::nullopt};
    if (!description.symbol.empty())
      info.parameter = ParameterInfo{.symbol = description.symbol,
                                     .shown = description.symbol,
                                     .meaning = description.symbol,
                                     .integer = false,
                                     .minimum = std::numeric_limits<double>::lowest(),
                                     .maximum = std::numeric_limits<double>::max()};
    return info;
  }

  std::mutex mutex_;
  std::map<ExternalMethodInfo, Method> methods_;
  std::deque<MethodInfo> infos_;
};

ExternalTable& external_table() {
  static ExternalTable table;
  return table;
}

bool is_external(Method method) {
  return static_cast<std::size_t>(method) >= kMappingMethods.size();
}

}  // namespace

std::span<const MethodInfo> all_methods() { return kMappingMethods; }

Method external_method(const ExternalMethodInfo& description) {
  return external_table().intern(description);
}

std::optional<ExternalMethodInfo> description_of_external(Method method) {
  if (!is_external(method)) return std::nullopt;
  const MethodInfo& known = info(method);
  return ExternalMethodInfo{
      .name = std::string(known.name),
      .label = std::string(known.label),
      .source = std::string(known.source),
      .symbol = known.parameter ? std::string(known.parameter->symbol) : std::string()};
}

const MethodInfo& info(Method method) {
  return is_external(method) ? external_table().info(method)
                             : kMappingMethods[static_cast<std::size_t>(method)];
}

bool on_graph(Method method) {
  const std::optional<ParameterInfo>& parameter = info(method).parameter;
  return parameter && parameter->counts_neighbours;
}

std::optional<Method> method_named(std::string_view name) {
  for (const MethodInfo& candidate : kMappingMethods)
    if (candidate.name == name) return candidate.method;
  return std::nullopt;
}

std::string_view nearest_method_name(std::string_view name) {
  std::vector<std::string_view> names;
  for (const MethodInfo& method : kMappingMethods) names.push_back(method.name);
  return nearest_word(name, names);
}

std::string slug(const MethodSetting& setting) {
  const MethodInfo& method = info(setting.method);
  if (!setting.parameter || !method.parameter) return std::string(method.name);
  // "K6", but "sigma2-1": a digit after a digit would read as one number.
  const std::string_view symbol = method.parameter->symbol;
  const std::string_view between = symbol.back() >= '0' && symbol.back() <= '9' ? "-" : "";
  return fmt::format("{}-{}{}{}", method.name, symbol, between, *setting.parameter);
}

namespace {

/// "4000", "1.4 × 10⁷" with no-break spaces: without an "e".
std::string number_words(double value) {
  const std::string text = fmt::format("{:g}", value);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  return text.substr(0, e) + "\u00A0×\u00A010" + raised(std::stoi(text.substr(e + 1)));
}

}  // namespace

std::string parameter_text(const MethodSetting& setting) {
  const MethodInfo& method = info(setting.method);
  if (!setting.parameter || !method.parameter) return "";
  return fmt::format("{} = {}", method.parameter->shown, number_words(*setting.parameter));
}

std::string label(const MethodSetting& setting) {
  const std::string parameter = parameter_text(setting);
  const std::string_view method = info(setting.method).label;
  return parameter.empty() ? std::string(method) : fmt::format("{}, {}", method, parameter);
}

}  // namespace mapproof
