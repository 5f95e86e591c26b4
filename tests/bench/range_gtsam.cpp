// range_gtsam GRAPH.g2o own|odometry: least squares by GTSAM of the graph that `mapproof slam`
// writes, at the noise that stands in it, from its own map or from odometry and the landmarks
// trilaterated on it. Prints "seconds S", then "pose I X Y" and, per landmark, "landmark I X Y" and
// its row of the joint covariance.
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <gtsam/geometry/Point2.h>
#include <gtsam/geometry/Pose2.h>
#include <gtsam/nonlinear/LevenbergMarquardtOptimizer.h>
#include <gtsam/nonlinear/Marginals.h>
#include <gtsam/nonlinear/NonlinearFactorGraph.h>
#include <gtsam/sam/RangeFactor.h>
#include <gtsam/slam/BetweenFactor.h>

namespace {

struct Graph {
  gtsam::NonlinearFactorGraph factors;
  std::map<gtsam::Key, gtsam::Pose2> poses;
  std::map<gtsam::Key, gtsam::Point2> landmarks;
  std::vector<std::tuple<gtsam::Key, gtsam::Key, gtsam::Pose2>> motions;
  std::vector<std::tuple<gtsam::Key, gtsam::Key, double>> ranges;
};

void add_motion(std::istream& fields, Graph& graph) {
  gtsam::Key from = 0, to = 0;
  double x = 0, y = 0, angle = 0;
  gtsam::Matrix3 information;
  fields >> from >> to >> x >> y >> angle;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      fields >> information(i, j);
      information(j, i) = information(i, j);
    }
  const gtsam::Pose2 motion(x, y, angle);
  graph.factors.emplace_shared<gtsam::BetweenFactor<gtsam::Pose2>>(
      from, to, motion, gtsam::noiseModel::Gaussian::Information(information));
  graph.motions.emplace_back(from, to, motion);
}

void add_range(std::istream& fields, Graph& graph) {
  gtsam::Key pose = 0, landmark = 0;
  double range = 0, information = 0;
  fields >> pose >> landmark >> range >> information;
  graph.factors.emplace_shared<gtsam::RangeFactor<gtsam::Pose2, gtsam::Point2>>(
      pose, landmark, range, gtsam::noiseModel::Isotropic::Sigma(1, 1 / std::sqrt(information)));
  graph.ranges.emplace_back(pose, landmark, range);
}

Graph read_graph(const char* file) {
  Graph graph;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string kind;
    fields >> kind;
    gtsam::Key key = 0;
    double x = 0, y = 0, angle = 0;
    if (kind == "VERTEX_SE2" && fields >> key >> x >> y >> angle)
      graph.poses[key] = gtsam::Pose2(x, y, angle);
    if (kind == "VERTEX_XY" && fields >> key >> x >> y) graph.landmarks[key] = gtsam::Point2(x, y);
    if (kind == "EDGE_SE2") add_motion(fields, graph);
    if (kind == "EDGE_RANGE_SE2_XY") add_range(fields, graph);
  }
  return graph;
}

void start_from_odometry(Graph& graph) {
  for (const auto& [from, to, motion] : graph.motions)
    graph.poses[to] = graph.poses[from].compose(motion);
  for (auto& [key, position] : graph.landmarks) {
    std::vector<gtsam::Vector3> rows;
    std::vector<double> sides;
    for (const auto& [pose, landmark, range] : graph.ranges) {
      if (landmark != key) continue;
      const gtsam::Point2 at = graph.poses[pose].translation();
      rows.emplace_back(-2 * at.x(), -2 * at.y(), 1);
      sides.push_back(range * range - at.squaredNorm());
    }
    // Odometry drifts: the first ranges alone.
    const std::size_t used = std::min(rows.size(), std::max<std::size_t>(10, rows.size() * 2 / 5));
    gtsam::Matrix A(used, 3);
    gtsam::Vector b(used);
    for (std::size_t i = 0; i < used; ++i) {
      A.row(i) = rows[i].transpose();
      b(i) = sides[i];
    }
    position = A.colPivHouseholderQr().solve(b).head<2>();
  }
}

double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  Graph graph = read_graph(arguments[1]);
  const auto& [first, start] = *graph.poses.begin();
  graph.factors.addPrior(first, start, gtsam::noiseModel::Isotropic::Sigma(3, 1e-6));
  if (std::string(arguments[2]) == "odometry") start_from_odometry(graph);
  gtsam::Values values;
  for (const auto& [key, pose] : graph.poses) values.insert(key, pose);
  gtsam::KeyVector landmarks;
  for (const auto& [key, position] : graph.landmarks) {
    values.insert(key, position);
    landmarks.push_back(key);
  }
  gtsam::LevenbergMarquardtParams parameters;
  parameters.setMaxIterations(200);
  parameters.setRelativeErrorTol(1e-8);
  const double begin = seconds();
  values = gtsam::LevenbergMarquardtOptimizer(graph.factors, values, parameters).optimize();
  const gtsam::Marginals marginals(graph.factors, values);
  const auto joint = marginals.jointMarginalCovariance(landmarks);
  std::cout.precision(12);
  std::cout << "seconds " << seconds() - begin << "\n";
  for (const auto& [key, pose] : graph.poses) {
    const auto found = values.at<gtsam::Pose2>(key);
    std::cout << "pose " << key << " " << found.x() << " " << found.y() << "\n";
  }
  for (const gtsam::Key key : landmarks) {
    const auto found = values.at<gtsam::Point2>(key);
    std::cout << "landmark " << key << " " << found.x() << " " << found.y();
    for (const gtsam::Key other : landmarks) {
      const gtsam::Matrix block = joint.at(key, other);
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) std::cout << " " << block(i, j);
    }
    std::cout << "\n";
  }
}
