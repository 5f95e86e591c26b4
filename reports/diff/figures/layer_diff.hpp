#pragma once

#include <set>
#include <string>

#include "reports/diff/figures/figure_layers.hpp"
#include "reports/diff/figures/figure_log.hpp"
#include "reports/diff/figures/figure_match.hpp"
#include "reports/diff/figures/figure_places.hpp"

namespace mapproof {

/// Compares the layers of one panel.
class LayerDiff {
 public:
  /// All of them must outlive it.
  /// @param shared  Of a figure that varies, the names of points that stand on both sides of the
  ///                panel, see shared_names(): which layer they are of is not judged. Else null.
  LayerDiff(std::size_t panel, const Figure& baseline, const FigurePlaces& places,
            const FigureOptions& options, FigureLog& log,
            const std::set<std::string>* shared = nullptr)
      : panel_(panel),
        figure_(baseline),
        places_(places),
        options_(options),
        log_(log),
        shared_(shared) {}

  /// Two layers of one kind.
  void compare(const LayerView& baseline, const LayerView& current);
  /// One side alone.
  void lone(const Layer& layer, bool removed);
  /// Counts the errors of the marks, whether they differ or not.
  void add_errors(const LayerView& baseline, const LayerView& current);
  /// "panel 2, polyline \"ISOMAP\"".
  std::string place(const LayerView& layer) const;

 private:
  void compare_point(const LayerView& a, std::size_t i, const LayerView& b, std::size_t j);
  void compare_values(const LayerView& a, const LayerView& b, const std::vector<Match>& matches);
  void compare_data(const Mark& a, const Mark& b);
  bool may_vary(const LayerView& layer, std::size_t point) const;
  void lone_points(const char* what, long count, const std::string& first);
  MarkMove mark_move(const LayerView& layer, std::size_t point, Point before, Point after) const;

  std::size_t panel_;
  const Figure& figure_;
  const FigurePlaces& places_;
  const FigureOptions& options_;
  FigureLog& log_;
  const std::set<std::string>* shared_;
  std::string place_;  ///< Of the layer at hand.
};

/// Names of the points that both panels have, in whatever layers.
std::set<std::string> shared_names(const Panel& a, const Panel& b);

}  // namespace mapproof
