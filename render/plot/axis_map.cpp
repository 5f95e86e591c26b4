#include "render/plot/axis_map.hpp"

#include <cmath>

#include "render/base/span.hpp"

namespace mapproof {
namespace {

constexpr double kPadding = 0.05;
constexpr double kMostElongated = 2.5;

struct Spans {
  Span x, y;

  void operator()(const Polyline& line) {
    x.see(line.x);
    y.see(line.y);
  }
  void operator()(const Band& band) {
    x.see(band.x);
    y.see(band.low);
    y.see(band.high);
  }
  void operator()(const Scatter& points) {
    for (std::size_t i = 0; i < points.x.size(); ++i) see(points.x[i], points.y[i]);
  }
  void operator()(const Segments& lines) {
    for (std::size_t i = 0; i < lines.x0.size(); ++i) {
      see(lines.x0[i], lines.y0[i]);
      see(lines.x1[i], lines.y1[i]);
    }
  }
  void operator()(const PointLabels&) {}
  void operator()(const Area& area) {
    for (std::size_t i = 0; i < area.x.size(); ++i) see(area.x[i], area.y[i]);
  }
  void operator()(const Ellipses& ellipses) {
    for (std::size_t i = 0; i < ellipses.x.size(); ++i) {
      const PanelLimits box = ellipse_box(ellipses, i);
      see(box.x.low, box.y.low);
      see(box.x.high, box.y.high);
    }
  }
  void operator()(const Cells& cells) {
    see(cells.x.low, cells.y.low);
    see(cells.x.high, cells.y.high);
  }
  void operator()(const ImageLayer& image) {
    see(image.x.low, image.y.low);
    see(image.x.high, image.y.high);
  }
  void operator()(const Texts& texts) {
    for (std::size_t i = 0; i < texts.x.size(); ++i) see(texts.x[i], texts.y[i]);
  }

 private:
  void see(double px, double py) {
    if (std::isnan(px) || std::isnan(py)) return;
    x.see(px);
    y.see(py);
  }
};

Range linear_range(Span span) {
  if (!span.known()) return {0.0, 1.0};
  const double size = std::max(std::abs(span.low), std::abs(span.high));
  const double width = span.high - span.low;
  const double padding = width > 1e-9 * size ? kPadding * width : std::max(0.5, 0.05 * size);
  return {span.low - padding, span.high + padding};
}

Range axis_range(const Axis& axis, Span span) {
  if (axis.limits) return *axis.limits;
  if (axis.scale == Scale::kLinear) return linear_range(span);
  if (!span.known()) return {0.1, 1.0};
  const double factor = std::max(std::pow(span.high / span.low, kPadding), 1.2);
  return {span.low / factor, span.high * factor};
}

void widen_to(Range& range, double least) {
  const double missing = least - (range.high - range.low);
  if (missing <= 0.0) return;
  range.low -= missing / 2.0;
  range.high += missing / 2.0;
}

}  // namespace

AxisMap::AxisMap(Scale scale, Range limits, double start_pt, double end_pt)
    : scale_(scale), start_pt_(start_pt) {
  const bool log = scale == Scale::kLog;
  low_ = log ? std::log10(limits.low) : limits.low;
  const double high = log ? std::log10(limits.high) : limits.high;
  points_per_unit_ = (end_pt - start_pt) / (high - low_);
}

double AxisMap::operator()(double value) const {
  const double position = scale_ == Scale::kLog ? std::log10(value) : value;
  return start_pt_ + (position - low_) * points_per_unit_;
}

PanelLimits ellipse_box(const Ellipses& ellipses, std::size_t i) {
  const double c = std::cos(ellipses.rotation_rad[i]), s = std::sin(ellipses.rotation_rad[i]);
  const double across = std::hypot(ellipses.a[i] * c, ellipses.b[i] * s);
  const double up = std::hypot(ellipses.a[i] * s, ellipses.b[i] * c);
  return {{ellipses.x[i] - across, ellipses.x[i] + across},
          {ellipses.y[i] - up, ellipses.y[i] + up}};
}

PanelLimits panel_limits(const Panel& panel) {
  Spans spans;
  for (const Layer& layer : panel.layers) std::visit(spans, layer);
  PanelLimits limits{axis_range(panel.x, spans.x), axis_range(panel.y, spans.y)};
  if (panel.equal_aspect) {
    widen_to(limits.x, (limits.y.high - limits.y.low) / kMostElongated);
    widen_to(limits.y, (limits.x.high - limits.x.low) / kMostElongated);
  }
  return limits;
}

}  // namespace mapproof
