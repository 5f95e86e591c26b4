#pragma once

#include <set>
#include <string>

#include "reports/diff/figures/figure_layers.hpp"
#include "reports/diff/figures/figure_log.hpp"
#include "reports/diff/figures/figure_match.hpp"
#include "reports/diff/figures/figure_places.hpp"

namespace mapproof {

/// One panel of a figure that is compared. What it refers to must outlive it.
struct ComparedPanel {
  std::size_t panel = 0;  ///< Its index in the figure.
  const Figure& figure;   ///< The baseline.
  const FigurePlaces& places;
  const FigureOptions& options;
  /// In a figure that varies: the names of the points that are on both sides of the panel, see
  /// shared_names(). It is not judged in which layer they are. Else null.
  const std::set<std::string>* shared = nullptr;
};

/// Compares the layers of one panel.
class LayerDiff {
 public:
  /// @param log  Must outlive this.
  LayerDiff(const ComparedPanel& panel, FigureLog& log) : panel_(panel), log_(log) {}

  /// Compares two layers of one kind.
  void compare(const LayerView& baseline, const LayerView& current);
  /// Adds a layer of one side only.
  void lone(const Layer& layer, bool removed);
  /// Adds the errors of the marks, whether they differ or not.
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

  ComparedPanel panel_;
  FigureLog& log_;
  std::string place_;  ///< The location of the layer that is compared.
};

/// Names of the points that both panels have, in any layers.
std::set<std::string> shared_names(const Panel& a, const Panel& b);

}  // namespace mapproof
