#pragma once

#include <compare>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mapproof {

/// The mapping methods: those of the paper [yairi2007, section 4.2], then approximations for large
/// maps. Those of others have values beyond these: see external_method().
enum class Method {
  kLpca,
  kSmacof,
  kSmacofKnn,
  kKpcaGaussian,
  kKpcaPolynomial,
  kIsomap,
  kLle,
  kLaplacianEigenmap,
  kHessianLle,
  kSde,
  kLandmarkIsomap,
  kLandmarkMvu,
};

/// The one number a method is tuned by.
struct ParameterInfo {
  std::string_view symbol;  ///< In files and ids: "K", "sigma2"; letters and digits of ASCII.
  std::string_view shown;   ///< In figures, tables and messages: "K", "σ²".
  std::string_view meaning;
  bool integer;
  double minimum;                  ///< Inclusive.
  double maximum;                  ///< Inclusive.
  bool counts_neighbours = false;  ///< Of the neighbour graph: below the number of landmarks, too.
};

/// Everything about a method that needs no solver.
struct MethodInfo {
  Method method;
  std::string_view name;   ///< In files and on the command line: "smacof-knn".
  std::string_view label;  ///< In figures and tables: "SMACOF, kNN weights".
  std::string_view summary;
  std::string_view source;  ///< Author and year, with the key in docs/references.bib in brackets.
  std::optional<ParameterInfo> parameter;
  std::optional<Method> starts_from = std::nullopt;  ///< Whose map its iteration begins with.
  /// What it is for maps of many landmarks; it is in no table of the paper, and no candidate where
  /// a method is chosen.
  std::optional<Method> approximates = std::nullopt;
};

/// A mapping method of somebody else, as records describe it.
struct ExternalMethodInfo {
  std::string name;         ///< In files: "tsne"; not that of a method of mapproof.
  std::string label;        ///< In figures and tables: "t-SNE (scikit-learn)".
  std::string source = {};  ///< Author and year; may be empty.
  std::string symbol = {};  ///< Of its parameter: "perplexity"; empty: it has none.

  auto operator<=>(const ExternalMethodInfo&) const = default;
};

/// The methods of mapproof in the order of the paper's tables, then those that approximate one.
std::span<const MethodInfo> all_methods();

/// The method of that description: a value beyond the enumerators, the same for the same
/// description as long as the program runs. Thread-safe.
Method external_method(const ExternalMethodInfo& description);

/// Its description; empty for a method of mapproof.
std::optional<ExternalMethodInfo> description_of_external(Method method);

/// Of a method of mapproof, or of one that external_method() gave. Thread-safe.
const MethodInfo& info(Method method);

/// Whether the method maps all landmarks by some of them, the reference landmarks, without an array
/// of landmarks x landmarks.
inline bool has_references(Method method) {
  return method == Method::kLandmarkIsomap || method == Method::kLandmarkMvu;
}

/// Whether the method works on the neighbour graph.
bool on_graph(Method method);

/// The method of mapproof of that name; empty if there is none.
std::optional<Method> method_named(std::string_view name);

/// The known method whose name is nearest to `name`, for "did you mean".
std::string_view nearest_method_name(std::string_view name);

/// A method with the value of its parameter, if it has one.
struct MethodSetting {
  Method method = Method::kLpca;
  std::optional<double> parameter;

  bool operator==(const MethodSetting&) const = default;
};

/// "isomap-K6", "lpca": unique among settings, safe in ids and file names.
std::string slug(const MethodSetting& setting);

/// "K = 6", "σ² = 0.5"; empty without a parameter.
std::string parameter_text(const MethodSetting& setting);

/// "ISOMAP, K = 6": for captions and legends.
std::string label(const MethodSetting& setting);

}  // namespace mapproof
