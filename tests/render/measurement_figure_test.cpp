#include "render/figures/diagrams/measurement.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/support/samples/drawn_panels.hpp"
#include "tests/support/samples/sample_studies.hpp"

namespace mapproof::test {
namespace {

/// A robot at (1, 1) and one landmark 0.3 m to its right.
Measurement one_landmark() {
  Measurement m;
  m.world = {2.5, 0.06, Points(1, 2)};
  m.world.landmarks_m << 1.3, 1.0;
  m.robot_m << 1.0, 1.0;
  m.reach_m = 0.5;
  m.views = {View::kVisible};
  return m;
}

TEST(MeasurementFigure, CastsAShadowBetweenTheTangentsOutToTheDisc) {
  const Figure figure = measurement_figure(one_landmark(), "m");
  const auto shadow = labelled<Area>(figure.panels[0], "shadow").value();
  ASSERT_GE(shadow.x.size(), 5u);
  // A tangent touches the cylinder: right angle between its radius and the ray.
  const double tangent = std::sqrt(0.3 * 0.3 - 0.03 * 0.03);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_NEAR(std::hypot(shadow.x[i] - 1.0, shadow.y[i] - 1.0), tangent, 1e-12);
    EXPECT_NEAR(std::hypot(shadow.x[i] - 1.3, shadow.y[i] - 1.0), 0.03, 1e-12);
  }
  for (std::size_t i = 2; i + 1 < shadow.x.size(); ++i) {
    EXPECT_NEAR(std::hypot(shadow.x[i] - 1.0, shadow.y[i] - 1.0), 0.5, 1e-12);
    EXPECT_LE(std::abs(std::atan2(shadow.y[i] - 1.0, shadow.x[i] - 1.0)), std::asin(0.1) + 1e-12);
  }
  EXPECT_TRUE(std::isnan(shadow.x.back()));  // The end of the outline.
}

TEST(MeasurementFigure, CastsNoShadowOfWhatIsOutOfReach) {
  Measurement m = one_landmark();
  m.views = {View::kOutOfReach};
  EXPECT_FALSE(labelled<Area>(measurement_figure(m, "m").panels[0], "shadow").has_value());
}

TEST(MeasurementFigure, TellsViewsApartByFillAndOutline) {
  const Measurement m = sample_measurement(Sensor::kVisibility, 50);
  const Panel panel = measurement_figure(m, "m").panels[0];
  const auto visible = labelled<Ellipses>(panel, "visible").value();
  const auto hidden = labelled<Ellipses>(panel, "hidden").value();
  const auto far = labelled<Ellipses>(panel, "out of reach").value();
  ASSERT_FALSE(visible.x.empty());
  ASSERT_FALSE(hidden.x.empty());
  EXPECT_NE(visible.fill, hidden.fill);
  EXPECT_NE(visible.fill, far.fill);
  EXPECT_NE(hidden.fill, far.fill);
  EXPECT_NE(hidden.width, far.width);
  for (const double radius : visible.a) EXPECT_DOUBLE_EQ(radius, 0.024);  // True size.
}

TEST(MeasurementFigure, CountsWhatIsSeenAndHidden) {
  const Measurement m = sample_measurement(Sensor::kVisibility, 50);
  const auto count = [&](View view) { return std::ranges::count(m.views, view); };
  const Figure figure = measurement_figure(m, "m");
  EXPECT_TRUE(contains(figure.caption,
                       "of 50 landmarks the robot sees " + std::to_string(count(View::kVisible))))
      << figure.caption;
  EXPECT_TRUE(contains(figure.alt, std::to_string(count(View::kHidden)) + " hidden"));
  EXPECT_TRUE(contains(figure.caption, "layout 2, pose 3"));
}

TEST(MeasurementFigure, DrawsARayToEachLandmarkWhoseBearingIsKnown) {
  Measurement m = sample_measurement(Sensor::kBearing, 20);
  m.bearings_rad(3) = NAN;
  const Panel panel = measurement_figure(m, "m").panels[0];
  std::size_t rays = labelled<Segments>(panel, "ray").value().x0.size();
  for (const Polyline& line : layers_of<Polyline>(panel))
    if (line.x.size() == 2 && line.label.empty()) ++rays;  // Those that are named.
  EXPECT_EQ(rays, 19u);
}

TEST(MeasurementFigure, AnArcRunsFromTheHeadingThroughTheBearing) {
  Measurement m = one_landmark();
  m.sensor = Sensor::kBearing;
  m.heading_rad = -std::numbers::pi / 4.0;
  m.world.landmarks_m << 1.9, 1.0;
  m.bearings_rad = Eigen::VectorXd::Constant(1, std::numbers::pi / 4.0);
  const Figure figure = measurement_figure(m, "m");
  const auto lines = layers_of<Polyline>(figure.panels[0]);
  const Polyline& arc = lines.back();
  EXPECT_NEAR(std::atan2(arc.y.front() - 1.0, arc.x.front() - 1.0), m.heading_rad, 1e-12);
  EXPECT_NEAR(arc.y.back(), 1.0, 1e-12);
  EXPECT_EQ(layers_of<PointLabels>(figure.panels[0])[0].text[0], "L1: 45°");
  EXPECT_TRUE(contains(figure.title, "1 landmark at 45°")) << figure.title;
}

TEST(MeasurementFigure, RefusesWhatIsNoMeasurement) {
  const auto refuses = [](auto change) {
    Measurement m = one_landmark();
    change(m);
    EXPECT_THROW(measurement_figure(m, "m"), InvalidInput);
  };
  refuses([](Measurement& m) { m.views.clear(); });
  refuses([](Measurement& m) { m.sensor = Sensor::kRange; });
  refuses([](Measurement& m) { m.sensor = Sensor::kBearing; });
  refuses([](Measurement& m) { m.reach_m = 0.0; });
  refuses([](Measurement& m) { m.robot_m.x() = NAN; });
  refuses([](Measurement& m) { m.world.landmarks_m(0, 0) = INFINITY; });
  refuses([](Measurement& m) { m.world.side_m = NAN; });
}

TEST(MeasurementFigure, ARobotWithinALandmarkCastsNoShadow) {
  Measurement m = one_landmark();
  m.robot_m << 1.3, 1.0;
  EXPECT_FALSE(labelled<Area>(measurement_figure(m, "m").panels[0], "shadow").has_value());
}

}  // namespace
}  // namespace mapproof::test
