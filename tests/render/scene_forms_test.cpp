#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "render/scene/drive_scene.hpp"
#include "render/scene/forming_scene.hpp"
#include "render/scene/map_scene.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/quadric_scene.hpp"
#include "render/scene/room.hpp"
#include "render/scene/space_scene.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/samples/sample_scenes.hpp"
#include "tests/support/samples/sample_slam.hpp"

namespace mapproof::test {
namespace {

/// Largest |f| over the sheet's and the lines' points, in units of the quadric at them.
double off_quadric(const QuadricSurface& surface, const Eigen::Matrix4d& Q) {
  std::vector<Point3> points = surface.sheet.points;
  points.insert(points.end(), surface.lines.from.begin(), surface.lines.from.end());
  points.insert(points.end(), surface.lines.to.begin(), surface.lines.to.end());
  double worst = 0.0;
  for (const Point3& p : points) {
    const Eigen::Vector4d v(p.x(), p.y(), p.z(), 1.0);
    worst = std::max(worst, std::abs(v.dot(Q * v)) / (Q.norm() * v.squaredNorm()));
  }
  return worst;
}

/// The part of an ellipsoid about its south pole.
QuadricPoints bowl_of_an_ellipsoid() {
  QuadricPoints cloud{SpacePoints(60, 3), Eigen::Matrix4d::Zero()};
  cloud.Q.diagonal() << 1.0 / 9.0, 1.0 / 4.0, 1.0 / 100.0, -1.0;
  for (Eigen::Index i = 0; i < 60; ++i) {
    const double turn = 0.4 * double(i), tilt = 0.02 * double(i);
    cloud.points.row(i) << 3.0 * std::sin(tilt) * std::cos(turn),
        2.0 * std::sin(tilt) * std::sin(turn), -10.0 * std::cos(tilt);
  }
  return cloud;
}

MapSceneSpec map_of_scale(double scale) {
  MapSceneSpec spec{
      .id = "map-scaled", .title = "Bearing, ISOMAP, K = 7", .map = sample_map(12, 0.12, 7)};
  spec.map.estimate *= scale;
  *spec.map.ground_truth_m *= scale;
  return spec;
}

TEST(MapScene, FillsTheImageHoweverSmallTheMapIs) {
  const Scene usual = map_scene(map_of_scale(1.0)), small = map_scene(map_of_scale(1e-13));
  const Projection project(usual.views[0].camera), project_small(small.views[0].camera);
  const std::vector<Point3>& floor = std::get<Surface>(usual.parts[0]).points;
  for (const Point3& corner : floor) {
    const Point at = project(corner), at_small = project_small(1e-13 * corner);
    EXPECT_NEAR(at_small.x, at.x, 1e-9);
    EXPECT_NEAR(at_small.y, at.y, 1e-9);
  }
}

TEST(MapScene, IsNoneBelowTheLengthsOfSinglePrecision) {
  EXPECT_TRUE(has_map_scene(map_of_scale(1e-13).map));
  for (const double scale : {1e-20, 1e-160, 1e-310})
    EXPECT_FALSE(has_map_scene(map_of_scale(scale).map)) << scale;
}

TEST(QuadricSurface, LiesOnTheQuadricAndReachesAllPoints) {
  const UpgradeClouds clouds = sample_clouds(0.0);
  for (const QuadricPoints& cloud : {clouds.before, clouds.after, bowl_of_an_ellipsoid()}) {
    const QuadricSurface surface = quadric_surface(cloud);
    ASSERT_GT(surface.sheet.triangles.size(), 3000U);
    EXPECT_LT(off_quadric(surface, cloud.Q), 1e-12);
    const SpacePoints sheet = Eigen::Map<const Eigen::Matrix3Xd>(surface.sheet.points[0].data(), 3,
                                                                 std::ssize(surface.sheet.points))
                                  .transpose();
    const double size =
        (cloud.points.colwise().maxCoeff() - cloud.points.colwise().minCoeff()).norm();
    for (const auto& point : cloud.points.rowwise())
      EXPECT_LT((sheet.rowwise() - point).rowwise().norm().minCoeff(), 0.06 * size);
  }
}

TEST(QuadricSurface, OfAPlaneIsNone) {
  QuadricPoints plane{SpacePoints::Zero(20, 3), Eigen::Matrix4d::Zero()};
  for (Eigen::Index i = 0; i < 20; ++i) plane.points.row(i) << 0.3 * double(i % 5), double(i), 0.0;
  plane.Q(2, 3) = plane.Q(3, 2) = 1.0;
  EXPECT_TRUE(quadric_surface(plane).sheet.triangles.empty());
}

TEST(QuadricDistances, AreThoseOfASphereToFirstOrder) {
  Random random(1);
  QuadricPoints cloud{SpacePoints(40, 3), Eigen::Matrix4d::Identity()};
  cloud.Q(3, 3) = -25.0;
  Eigen::VectorXd exact(40);
  for (Eigen::Index i = 0; i < 40; ++i) {
    exact(i) = random.uniform(-1e-3, 1e-3);
    const Eigen::RowVector3d way(random.normal(), random.normal(), random.normal());
    cloud.points.row(i) = (5.0 + exact(i)) * way.normalized();
  }
  EXPECT_LT((quadric_distances(cloud) - exact.cwiseAbs()).cwiseAbs().maxCoeff(), 1e-6);
}

QuadricSceneSpec quadric_spec(double noise) {
  return {
      .id = "quadric", .title = "t", .name = "n", .clouds = sample_clouds(noise), .record_ids = {}};
}

TEST(QuadricScene, HasTwoViewsWithASheetAndTheSamePointsEach) {
  const Scene scene = quadric_scene(quadric_spec(0.5));
  ASSERT_EQ(scene.views.size(), 2U);
  for (const Shot& view : scene.views) {
    int sheets = 0;
    for (const std::size_t part : view.parts) {
      if (const auto* spheres = std::get_if<Spheres>(&scene.parts[part])) {
        EXPECT_EQ(spheres->at.size(), 150U);
        EXPECT_EQ(spheres->tones.values.back(), 447.0);
      }
      sheets += std::holds_alternative<Surface>(scene.parts[part]) ? 1 : 0;
    }
    EXPECT_EQ(sheets, 1);
  }
}

TEST(QuadricScene, TellsHeightsInSquareMetresThoughTheyAreDrawnShorter) {
  const QuadricSceneSpec spec = quadric_spec(0.0);
  const Scene scene = quadric_scene(spec);
  const Rule& height = scene.views[1].rules[2];
  EXPECT_GT(height.range.high, spec.clouds.after.points.col(2).maxCoeff());
  EXPECT_LT(height.range.high, 1.6 * spec.clouds.after.points.col(2).maxCoeff());
  EXPECT_LT((height.to - height.from).norm(), 25.0);
}

TEST(QuadricScene, TurnsTheBowlUprightAndTellsTheNoise) {
  QuadricSceneSpec spec = quadric_spec(0.5);
  const std::string alt = quadric_scene(spec).alt;
  EXPECT_NE(alt.find("0.53 m\u00B2 of a height"), std::string::npos) << alt;
  // Mirrored through the origin it is the same scene.
  const Scene scene = quadric_scene(spec);
  spec.clouds.before.points *= -1.0;
  spec.clouds.before.Q.topRightCorner<3, 1>() *= -1.0;
  spec.clouds.before.Q.bottomLeftCorner<1, 3>() *= -1.0;
  const Scene turned = quadric_scene(spec);
  EXPECT_LT((turned.views[0].camera.eye - scene.views[0].camera.eye).norm(), 1e-6);
}

TEST(QuadricScene, RefusesCloudsThatDoNotFit) {
  const auto refused = [](auto change) {
    QuadricSceneSpec spec = quadric_spec(0.1);
    change(spec.clouds);
    EXPECT_FALSE(has_quadric_scene(spec.clouds));
    EXPECT_THROW(quadric_scene(spec), InvalidInput);
  };
  refused([](UpgradeClouds& c) { c.steps.pop_back(); });
  refused([](UpgradeClouds& c) { c.before.points(0, 0) = NAN; });
  refused([](UpgradeClouds& c) { c.after.Q(1, 1) = HUGE_VAL; });
  refused([](UpgradeClouds& c) { c.after.points.setOnes(); });
  refused([](UpgradeClouds& c) { c.before.points *= 1e9; });
  refused([](UpgradeClouds& c) { c.after.points.col(2).setConstant(5.0); });
  refused([](UpgradeClouds& c) { c.steps.back() = c.steps.front(); });
  refused([](UpgradeClouds& c) { c = {}; });
}

SpaceSceneSpec space_spec() {
  return {.id = "space", .title = "t", .run = sample_space_run(), .record_ids = {}};
}

const Rods& error_rods(const Scene& scene, std::size_t view) {
  const std::vector<std::size_t>& parts = scene.views[view].parts;
  return std::get<Rods>(scene.parts[parts[parts.size() - 2]]);
}

TEST(SpaceScene, JoinsGroundTruthAndEstimateByRodsAsLongAsItSays) {
  const SpaceSceneSpec spec = space_spec();
  const Scene scene = space_scene(spec);
  ASSERT_EQ(scene.views.size(), 2U);
  for (std::size_t view = 0; view < 2; ++view) {
    const Rods& rods = error_rods(scene, view);
    ASSERT_EQ(rods.from.size(), 10U);
    for (std::size_t n = 0; n < 10; ++n) {
      const auto row = static_cast<Eigen::Index>(n);
      const Point3 ground_truth = spec.run.landmarks_m.row(row).transpose();
      const Point3 estimate = spec.run.records[view].estimate.landmarks_m.row(row).transpose();
      EXPECT_LT((rods.from[n] - ground_truth).norm(), 1e-12);
      EXPECT_LT((rods.to[n] - ground_truth - 10.0 * (estimate - ground_truth)).norm(), 1e-9);
    }
  }
  EXPECT_NE(scene.caption.find("10 times"), std::string::npos);
}

TEST(SpaceScene, DrawsLargeErrorsAsTheyAre) {
  SpaceSceneSpec spec = space_spec();
  for (SpaceRecord& record : spec.run.records) record.landmarks_error_m = 3.0;
  EXPECT_EQ(space_scene(spec).caption.find("times"), std::string::npos);
}

TEST(SpaceScene, OfARecordWithoutAMapSaysSo) {
  SpaceSceneSpec spec = space_spec();
  SpaceRecord& record = spec.run.records[1];
  record.estimate.landmarks_m.setConstant(NAN);
  record.estimate.positions_m.resize(0, 3);
  record.landmarks_error_m.reset();
  const Scene scene = space_scene(spec);
  ASSERT_EQ(scene.notes.size(), 1U);
  EXPECT_EQ(scene.notes[0].text, "No landmark known: no map came out.");
  EXPECT_NE(scene.alt.find("No landmark known: no map"), std::string::npos);
}

TEST(SpaceScene, LeavesOutAndCountsWhatIsFarAway) {
  SpaceSceneSpec spec = space_spec();
  spec.run.records[0].estimate.positions_m.row(7) << 1e12, 0.0, 0.0;
  spec.run.records[0].estimate.landmarks_m.row(2) << 0.0, -1e15, 0.0;
  const Scene scene = space_scene(spec);
  EXPECT_EQ(scene.notes.at(0).text, "6 landmarks known: 1 estimated position is far outside.");
  EXPECT_EQ(error_rods(scene, 0).from.size(), 9U);
}

TEST(SpaceScene, RefusesWhatDoesNotFit) {
  const auto refused = [](auto change) {
    SpaceSceneSpec spec = space_spec();
    change(spec.run);
    EXPECT_THROW(space_scene(spec), InvalidInput);
  };
  refused([](SpaceRun& run) { run.records.clear(); });
  refused([](SpaceRun& run) { run.positions_m(3, 1) = NAN; });
  refused([](SpaceRun& run) { run.landmarks_m.conservativeResize(9, 3); });
  refused([](SpaceRun& run) { run.records[0].estimate.positions_m.conservativeResize(3, 3); });
}

FormingSceneSpec forming_spec(int maps) {
  FormingSceneSpec spec{.id = "forming", .title = "t", .world = {}, .maps = {}};
  for (int i = 1; i <= maps; ++i) {
    spec.maps.push_back(sample_map(20, 1.0 / i, 3));
    spec.maps.back().step = 100 * i;
  }
  spec.world = {2.5, 0.048, *spec.maps[0].ground_truth_m};
  return spec;
}

/// The pillars of a view's landmarks, before its arrows.
const Rods& landmarks_of(const Scene& scene, const Shot& view) {
  return std::get<Rods>(scene.parts[view.parts[view.parts.size() - 2]]);
}

TEST(FormingScene, IsAFilmStripOfOneCameraFromTheFirstToTheLastMap) {
  const FormingSceneSpec spec = forming_spec(9);
  const Scene scene = forming_scene(spec);
  ASSERT_EQ(scene.views.size(), 6U);
  EXPECT_TRUE(scene.views.front().title.starts_with("100 steps"));
  EXPECT_TRUE(scene.views.back().title.starts_with("900 steps"));
  for (const Shot& view : scene.views) {
    EXPECT_EQ(view.camera, scene.views[0].camera);
    const Rods& arrows = std::get<Rods>(scene.parts[view.parts.back()]);
    EXPECT_TRUE(arrows.arrow);
    EXPECT_TRUE(arrows.tones.values.empty());
  }
  EXPECT_EQ(scene.columns, 3U);
  EXPECT_EQ(forming_scene(forming_spec(4)).columns, 2U);
  EXPECT_EQ(forming_scene(forming_spec(1)).views.size(), 1U);
}

TEST(FormingScene, ColoursLandmarksByTheirErrorsOnOneRampForAllMaps) {
  FormingSceneSpec spec = forming_spec(6);
  for (int i = 0; i < 6; ++i) spec.maps[i].estimate = sample_map(20, 0.3 / (i + 1), 3).estimate;
  spec.maps[1].estimate.row(7).setConstant(NAN);
  const Scene scene = forming_scene(spec);
  std::vector<double> errors;
  for (const MapRecord& map : spec.maps)
    for (Eigen::Index i = 0; i < map.estimate.rows(); ++i)
      if (map.estimate.row(i).allFinite())
        errors.push_back((map.estimate.row(i) - map.ground_truth_m->row(i)).norm());
  std::ranges::sort(errors);
  for (std::size_t k = 0; k < scene.views.size(); ++k) {
    const Rods& pillars = landmarks_of(scene, scene.views[k]);
    ASSERT_EQ(pillars.tones.values.size(), pillars.from.size());
    EXPECT_EQ(pillars.from.size() + spec.maps[k].anchors.size(), 20U);
    EXPECT_EQ(pillars.tones.limits.low, 0.0);
    EXPECT_EQ(pillars.tones.limits.high, errors[std::lround(0.95 * double(errors.size() - 1))]);
    EXPECT_EQ(std::ranges::count_if(pillars.tones.values, [](double e) { return std::isnan(e); }),
              k == 1 ? 1 : 0);
  }
  // The pillar at a landmark's true position has that landmark's error.
  const Rods& first = landmarks_of(scene, scene.views[0]);
  for (std::size_t i = 0; i < first.from.size(); ++i) {
    Eigen::Index row = 0;
    const Eigen::RowVector2d at(first.from[i].x(), first.from[i].y());
    EXPECT_LT((spec.world.landmarks_m.rowwise() - at).rowwise().norm().minCoeff(&row), 1e-15);
    EXPECT_EQ(first.tones.values[i],
              (spec.maps[0].estimate.row(row) - spec.world.landmarks_m.row(row)).norm());
  }
}

TEST(FormingFilm, HasAFrameAMapThatDiffersInItsErrorsAlone) {
  FormingSceneSpec spec = forming_spec(9);
  spec.maps[2].estimate.row(5) << 1e7, 0.0;
  const Film film = forming_film(spec);
  ASSERT_EQ(film.frames.size(), 9U);
  for (const Scene& frame : film.frames) {
    ASSERT_EQ(frame.views.size(), 1U);
    EXPECT_EQ(frame.views[0].camera, film.frames[0].views[0].camera);
    EXPECT_EQ(frame.title, film.frames[0].title);
    EXPECT_TRUE(frame.notes.empty());
    Scene other = frame;  // But for what tells frames apart.
    other.id = film.frames[0].id;
    other.alt = film.frames[0].alt;
    other.record_ids = film.frames[0].record_ids;
    other.caption = film.frames[0].caption;
    other.views[0].title = film.frames[0].views[0].title;
    for (const std::size_t part : {other.parts.size() - 2, other.parts.size() - 1}) {
      Rods& rods = std::get<Rods>(other.parts[part]);
      const Rods& of_first = std::get<Rods>(film.frames[0].parts[part]);
      EXPECT_EQ(rods.label, of_first.label);
      if (rods.arrow) rods.from = of_first.from, rods.to = of_first.to;
      rods.tones.values = of_first.tones.values;
    }
    EXPECT_EQ(other, film.frames[0]);
  }
  EXPECT_NE(film.frames[2].views[0].title.find("far outside"), std::string::npos);
}

TEST(FormingFilm, ShowsTheLastStepsOfThePathUpToEachMapAndTheRobotAtItsEnd) {
  FormingSceneSpec spec = forming_spec(3);
  spec.path_m.resize(400, 2);
  for (Eigen::Index i = 0; i < 400; ++i) spec.path_m.row(i) << 0.005 * double(i), 1.0;
  const Film film = forming_film(spec);
  for (std::size_t k = 0; k < film.frames.size(); ++k) {
    double first = HUGE_VAL, last = -HUGE_VAL, robot = NAN;
    for (const Part& part : film.frames[k].parts) {
      if (const auto* tube = std::get_if<Tube>(&part)) {
        first = std::min(first, tube->points.front().x());
        last = std::max(last, tube->points.back().x());
      }
      if (const auto* rods = std::get_if<Rods>(&part); rods != nullptr && rods->label == "robot")
        robot = rods->from.at(0).x();
    }
    const int steps = spec.maps[k].step;
    EXPECT_DOUBLE_EQ(last, 0.005 * (steps - 1));
    EXPECT_DOUBLE_EQ(first, 0.005 * std::max<double>(0, steps - 1 - double(kShownSteps)));
    EXPECT_EQ(robot, last);
  }
  for (const Part& part : forming_scene(spec).parts)
    EXPECT_FALSE(std::holds_alternative<Tube>(part)) << "Six small rooms have no path.";
}

TEST(FadingPath, IsNoLongerThanARoomCanShow) {
  constexpr double kSide = 2.0;
  Points walk(400, 2);  // To and fro, half the room each step.
  for (Eigen::Index i = 0; i < 400; ++i) walk.row(i) << (i % 2 == 0 ? 0.5 : 1.5), 1.0;
  EXPECT_EQ(first_shown(walk, 399, kSide), 396) << "1.5 sides are three steps.";
  double length = 0.0;
  for (const Tube& piece : fading_path(walk, 399, kSide))
    for (std::size_t i = 1; i < piece.points.size(); ++i)
      length += (piece.points[i] - piece.points[i - 1]).norm();
  EXPECT_NEAR(length, 3.0, 1e-12);
  EXPECT_EQ(first_shown(100.0 * walk, 399, kSide), 398) << "One step is shown at least.";
  EXPECT_EQ(first_shown(1e-6 * walk, 399, kSide), 399 - kShownSteps);
  walk.row(397).setConstant(NAN);
  EXPECT_EQ(first_shown(walk, 399, kSide), 394) << "Steps from and to nowhere have no length.";
}

TEST(Grid, HasItsLinesAtRoundValuesWithinTheGround) {
  const Ground ground{{-3.2, 10.0}, {7.1, 14.0}};
  const Surface grid = grid_of(ground);
  std::vector<double> across, along;
  for (std::size_t i = 0; i + 3 < grid.points.size(); i += 4) {
    const Point3 middle = (grid.points[i] + grid.points[i + 2]) / 2.0;
    const Point3 size = (grid.points[i + 2] - grid.points[i]).cwiseAbs();
    (size.x() < size.y() ? across : along).push_back(size.x() < size.y() ? middle.x() : middle.y());
    for (std::size_t k = i; k < i + 4; ++k) {
      EXPECT_TRUE(grid.points[k].x() >= -3.2 && grid.points[k].x() <= 7.1);
      EXPECT_TRUE(grid.points[k].y() >= 10.0 && grid.points[k].y() <= 14.0);
    }
  }
  ASSERT_EQ(across.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(across[i], -2.0 + 2.0 * double(i), 1e-12);
  ASSERT_EQ(along.size(), 1U) << "None on the edges at 10 and 14.";
  EXPECT_NEAR(along[0], 12.0, 1e-12);
}

/// The landmark pillars and the balls of a drive.
struct DriveParts {
  const Surface* path = nullptr;
  const Rods* pillars = nullptr;
  const Spheres* balls = nullptr;
  std::vector<std::string> labels;
};

DriveParts parts_of(const Scene& scene) {
  DriveParts parts;
  for (const Part& part : scene.parts) {
    if (const auto* surface = std::get_if<Surface>(&part)) {
      if (!surface->tones.values.empty()) parts.path = surface;
    }
    if (const auto* rods = std::get_if<Rods>(&part)) parts.pillars = rods;
    if (const auto* spheres = std::get_if<Spheres>(&part)) parts.balls = spheres;
    std::visit([&](const auto& one) { parts.labels.push_back(one.label); }, part);
  }
  return parts;
}

DriveSceneSpec drive_spec(const SlamRun& run) {
  return {.id = "drive", .title = "t", .run = run, .record_ids = {run.id}};
}

TEST(DriveScene, ColoursThePathByItsErrorAndSetsLandmarksWhereTheyAre) {
  const SlamRun run = sample_drive("plaza-1", 800, 3);
  const SlamRecord& refined =
      *std::ranges::find(run.records, SlamMethod::kRefined, &SlamRecord::method);
  const Scene scene = drive_scene(drive_spec(run));
  const DriveParts parts = parts_of(scene);
  ASSERT_NE(parts.path, nullptr);
  const double most = std::ranges::max(refined.error_m);
  EXPECT_GT(parts.path->tones.limits.high, 0.5 * most);
  EXPECT_LE(parts.path->tones.limits.high, most);
  // A thinned path has lost no peak, and lies within half its width of the estimate.
  EXPECT_NEAR(std::ranges::max(parts.path->tones.values), most, 1e-4 * most);
  for (const Point3& p : parts.path->points) {
    const Eigen::RowVector2d at(p.x(), p.y());
    EXPECT_LT((refined.estimate.path.positions_m.rowwise() - at).rowwise().norm().minCoeff(), 0.5);
  }
  ASSERT_EQ(parts.pillars->from.size(), 4U);
  ASSERT_EQ(parts.balls->at.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    EXPECT_EQ(parts.pillars->from[i].x(), (*run.log.true_landmarks)(row, 0));
    EXPECT_EQ(parts.balls->at[i].y(), refined.estimate.landmarks_m(row, 1));
  }
  EXPECT_NE(std::ranges::find(parts.labels, "true path"), parts.labels.end());
  EXPECT_NE(std::ranges::find(parts.labels, "dead reckoning"), parts.labels.end());
  EXPECT_NE(scene.caption.find(" The wide band under it is the true path."), std::string::npos);
}

TEST(DriveScene, WithoutGroundTruthIsColouredByTimeAndClaimsNoError) {
  SlamRun run = sample_drive("own", 500, 3);
  run.log.ground_truth.reset();
  run.log.true_landmarks.reset();
  for (SlamRecord& record : run.records) record.error_m.clear(), record.errors.clear();
  const Scene scene = drive_scene(drive_spec(run));
  const DriveParts parts = parts_of(scene);
  EXPECT_EQ(parts.path->tones.limits.low, 0.0);
  EXPECT_LE(parts.path->points.size(), 1000U) << "Two for each position at most.";
  EXPECT_EQ(parts.path->tones.limits.high, run.records.back().estimate.path.time_s(499));
  EXPECT_TRUE(std::ranges::none_of(parts.labels, [](const std::string& label) {
    return label.find("error") != std::string::npos || label.find("true") != std::string::npos;
  }));
  EXPECT_EQ(scene.alt.find("error"), std::string::npos);
}

TEST(DriveScene, LeavesOutWhatIsNotKnownOrFarAway) {
  SlamRun run = sample_drive("own", 500, 3);
  SlamRecord& refined = *std::ranges::find(run.records, SlamMethod::kRefined, &SlamRecord::method);
  refined.estimate.path.positions_m.row(250).setConstant(NAN);
  refined.estimate.path.positions_m.row(300) << 1e9, 0.0;
  refined.error_m[300] = NAN;
  refined.estimate.landmarks_m.row(1).setConstant(NAN);
  const Scene scene = drive_scene(drive_spec(run));
  const DriveParts parts = parts_of(scene);
  EXPECT_EQ(parts.balls->at.size(), 3U);
  for (const Point3& p : parts.path->points) EXPECT_LT(p.norm(), 1e3);
  ASSERT_EQ(scene.notes.size(), 1U);
  EXPECT_TRUE(scene.notes[0].text.starts_with("Outside the image: ")) << scene.notes[0].text;
}

TEST(DriveScene, NeedsAPathOfTwoPositions) {
  SlamRun run = sample_drive("own", 500, 3);
  EXPECT_TRUE(has_drive_scene(run, SlamMethod::kRefined));
  EXPECT_FALSE(has_drive_scene(run, SlamMethod::kRefinedFromRandom));
  for (SlamRecord& record : run.records)
    record.estimate.path.positions_m.bottomRows(499).setConstant(NAN);
  EXPECT_FALSE(has_drive_scene(run, SlamMethod::kRefined));
  EXPECT_THROW(drive_scene(drive_spec(run)), InvalidInput);
}

TEST(FormingScene, RefusesMapsThatAreNotOfOneRoomOneAfterTheOther) {
  const auto refused = [](auto change) {
    FormingSceneSpec spec = forming_spec(3);
    change(spec);
    EXPECT_THROW(forming_scene(spec), InvalidInput);
    EXPECT_THROW(forming_film(spec), InvalidInput);
  };
  refused([](FormingSceneSpec& s) { s.maps.clear(); });
  refused([](FormingSceneSpec& s) { s.maps[1].step = 100; });
  refused([](FormingSceneSpec& s) { s.maps[1].frame = Frame::kSimilarity; });
  refused([](FormingSceneSpec& s) { s.maps[1].estimate.conservativeResize(3, 2); });
  refused([](FormingSceneSpec& s) { s.world.side_m = NAN; });
  refused([](FormingSceneSpec& s) { s.maps[0].anchors = {99}; });
  refused([](FormingSceneSpec& s) { s.path_m = Points::Zero(299, 2); });
}

}  // namespace
}  // namespace mapproof::test
