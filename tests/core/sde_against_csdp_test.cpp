// Our solver compared with CSDP's, by fixed simulated observations of both sensors.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <new>
#include <numeric>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/embed/sde/csdp.hpp"
#include "core/embed/sde/sde.hpp"
#include "core/model/sensor.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/samples/observed.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::procrustes_gap;

using Setting = std::tuple<Sensor, int>;

double size_of(const Embedding& map) { return map.coordinates.rowwise().norm().maxCoeff(); }

/// Few neighbours leave parts of the graph that rotate about hinges and lose no variance: the
/// optimum is then a face, and where on it a solver ends moves the map by some 1e-3, up to 1e-2
/// seen.
class SdeAgainstCsdp : public ::testing::TestWithParam<Setting> {
 protected:
  static Eigen::MatrixXd distances() {
    return test::observed_distances(40, std::get<Sensor>(GetParam()), 600, 11);
  }
  static double same_map() { return std::get<int>(GetParam()) == 4 ? 2e-2 : 1e-3; }
  static Embedding unfolded(const Eigen::MatrixXd& D, SdpSolver solver) {
    return sde(D, {.neighbours = {.neighbours = std::get<int>(GetParam())}, .solver = solver});
  }
};

/// Bearings have no ties among neighbours, which the numbers of the landmarks would break.
class SdeWithoutTies : public SdeAgainstCsdp {};

TEST_P(SdeAgainstCsdp, BothCertifyOneOptimumAndGiveOneMap) {
  const Eigen::MatrixXd D = distances();
  const Embedding own = unfolded(D, SdpSolver::kInteriorPoint);
  const Embedding other = unfolded(D, SdpSolver::kCsdp);
  ASSERT_TRUE(own.certificate && other.certificate);
  // Ours, and not the CSDP that runs where ours fails.
  EXPECT_EQ(own.certificate->solver, SdpSolver::kInteriorPoint);
  EXPECT_EQ(other.certificate->solver, SdpSolver::kCsdp);
  EXPECT_LE(own.certificate->relative_gap, 1e-7);
  EXPECT_LE(own.certificate->constraint_residual, 1e-7);
  const double objective = other.certificate->primal;
  EXPECT_NEAR(own.certificate->primal, objective, 1e-6 * objective);
  // The bound of each one holds for the other's solution.
  EXPECT_LE(own.certificate->primal, other.certificate->dual * (1.0 + 1e-7));
  EXPECT_LE(other.certificate->primal, own.certificate->dual * (1.0 + 1e-7));
  EXPECT_LE(procrustes_gap(other.coordinates, own.coordinates), same_map() * size_of(own));
}

TEST_P(SdeWithoutTies, TheOrderOfTheLandmarksDoesNotMoveThem) {
  const Eigen::MatrixXd D = distances();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(D.rows()));
  std::iota(order.begin(), order.end(), 0);
  Random random(3);
  for (std::size_t i = order.size(); i-- > 1;)
    std::swap(order[i], order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  const Embedding map = unfolded(D, SdpSolver::kInteriorPoint);
  const Embedding shuffled = unfolded(D(order, order), SdpSolver::kInteriorPoint);
  EXPECT_NEAR(shuffled.certificate->primal, map.certificate->primal,
              1e-7 * map.certificate->primal);
  const Points reordered = map.coordinates(order, Eigen::all);
  EXPECT_LE(procrustes_gap(reordered, shuffled.coordinates), same_map() * size_of(map));
}

TEST_P(SdeAgainstCsdp, TheUnitOfTheDistancesIsTheUnitOfTheMap) {
  const Eigen::MatrixXd D = distances();
  const Embedding map = unfolded(D, SdpSolver::kInteriorPoint);
  const Embedding larger = unfolded(1024.0 * D, SdpSolver::kInteriorPoint);
  EXPECT_EQ(larger.coordinates, Points(1024.0 * map.coordinates));
}

std::string setting_name(const ::testing::TestParamInfo<Setting>& setting) {
  return fmt::format("{}{}", name(std::get<Sensor>(setting.param)), std::get<int>(setting.param));
}

/// The program of a chain of points.
unfolding::Problem chain(Eigen::Index points) {
  unfolding::Problem problem;
  problem.mass = Eigen::VectorXd::Ones(points);
  for (Eigen::Index i = 1; i < points; ++i) problem.pairs.emplace_back(i - 1, i);
  problem.squared = Eigen::VectorXd::Ones(points - 1);
  return problem;
}

/// From here on, the process gets so many bytes more and no others.
void allow_more_memory(std::size_t bytes) {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0;
  file >> pages;
  const rlim_t limit = pages * static_cast<std::size_t>(::getpagesize()) + bytes;
  const rlimit limits{limit, limit};
  ::setrlimit(RLIMIT_AS, &limits);
}

TEST(Csdp, WithoutMemoryThrowsAndDoesNotEndTheProgram) {
  test::skip_if_sanitized();
  if (std::getenv("MAPPROOF_EMULATED") != nullptr)
    GTEST_SKIP() << "an emulator takes its own memory from the limit";
  constexpr int kThrown = 42;
  EXPECT_EXIT(
      {
        const unfolding::Problem problem = chain(1000);  // Matrices of 8 MB.
        allow_more_memory(std::size_t{30} << 20);
        try {
          unfolding::solve_with_csdp(problem);
        } catch (const std::bad_alloc&) {
          ::_exit(kThrown);
        }
      },
      ::testing::ExitedWithCode(kThrown), "^$");
}

INSTANTIATE_TEST_SUITE_P(Sde, SdeAgainstCsdp,
                         ::testing::Combine(::testing::Values(Sensor::kVisibility,
                                                              Sensor::kBearing),
                                            ::testing::Values(4, 7, 10)),
                         setting_name);
INSTANTIATE_TEST_SUITE_P(Sde, SdeWithoutTies,
                         ::testing::Combine(::testing::Values(Sensor::kBearing),
                                            ::testing::Values(4, 7, 10)),
                         setting_name);

}  // namespace
}  // namespace mapproof
