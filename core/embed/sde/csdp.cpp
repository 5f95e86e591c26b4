#include "core/embed/sde/csdp.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

#include <csdp/declarations.h>
#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"

// CSDP calls this where it finds no memory (scripts/cmake/FindCsdp.cmake). CSDP is C: the jump
// skips nothing that has to be undone, except memory.
extern "C" {
[[noreturn]] void mapproof_csdp_exit(int) { throw std::bad_alloc(); }
int mapproof_csdp_puts(const char*) { return 0; }
FILE* mapproof_csdp_stdout = stdout;
}

namespace mapproof::unfolding {
namespace {

/// A matrix of one block, freed as CSDP allocated it.
class Block {
 public:
  explicit Block(const blockmatrix& like) { alloc_mat(like, &matrix_); }
  ~Block() { free_mat(matrix_); }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  blockmatrix& operator*() { return matrix_; }
  Eigen::Map<Eigen::MatrixXd> values() {
    const blockrec& block = matrix_.blocks[1];
    return {block.data.mat, block.blocksize, block.blocksize};
  }

 private:
  blockmatrix matrix_{};
};

/// The same, with the upper triangle alone.
class PackedBlock {
 public:
  explicit PackedBlock(const blockmatrix& like) { alloc_mat_packed(like, &matrix_); }
  ~PackedBlock() { free_mat_packed(matrix_); }
  PackedBlock(const PackedBlock&) = delete;
  PackedBlock& operator=(const PackedBlock&) = delete;

  blockmatrix& operator*() { return matrix_; }

 private:
  blockmatrix matrix_{};
};

/// The objective: inner products with the first point at the origin, summed about the centroid.
class Objective {
 public:
  explicit Objective(const Eigen::VectorXd& mass)
      : values_(mass.tail(mass.size() - 1).asDiagonal()) {
    const auto rest = mass.tail(mass.size() - 1);
    values_.noalias() -= rest * rest.transpose() / mass.sum();
    records_[1].data.mat = values_.data();
    records_[1].blockcategory = MATRIX;
    records_[1].blocksize = static_cast<int>(values_.rows());
  }

  blockmatrix matrix() { return {.nblocks = 1, .blocks = records_}; }
  Eigen::Index size() const { return values_.rows(); }

 private:
  Eigen::MatrixXd values_;
  blockrec records_[2] = {};  // CSDP counts from 1.
};

/// One constraint's nonzeros in the upper triangle; CSDP counts everything from 1.
struct Constraint {
  double entries[4] = {};
  int rows[4] = {};
  int columns[4] = {};
  sparseblock block = {};

  void add(Eigen::Index row, Eigen::Index column, double value) {
    const int position = ++block.numentries;
    entries[position] = value;
    rows[position] = static_cast<int>(row);
    columns[position] = static_cast<int>(column);
  }
};

/// |y_i - y_j|^2 for all pairs, linked as CSDP wants them.
class Constraints {
 public:
  explicit Constraints(const Problem& problem)
      : constraints_(problem.pairs.size()), heads_(problem.pairs.size() + 1) {
    for (std::size_t k = 0; k < constraints_.size(); ++k) {
      Constraint& constraint = constraints_[k];
      const auto& [i, j] = problem.pairs[k];
      // Point i is row i, counted from 1, since point 0 is the origin.
      if (i > 0) constraint.add(i, i, 1.0);
      if (i > 0) constraint.add(i, j, -1.0);
      constraint.add(j, j, 1.0);
      sparseblock& block = constraint.block;
      block.entries = constraint.entries;
      block.iindices = constraint.rows;
      block.jindices = constraint.columns;
      block.blocknum = 1;
      block.blocksize = static_cast<int>(problem.points() - 1);
      block.constraintnum = static_cast<int>(k + 1);
      block.issparse = 1;
      block.nextbyblock = k + 1 < constraints_.size() ? &constraints_[k + 1].block : nullptr;
      heads_[k + 1].blocks = &block;
    }
  }

  constraintmatrix* heads() { return heads_.data(); }
  sparseblock* first() { return &constraints_.front().block; }

 private:
  std::vector<Constraint> constraints_;
  std::vector<constraintmatrix> heads_;
};

/// The list that makefill() allocates.
struct Fill {
  constraintmatrix matrix{};

  Fill() = default;
  Fill(const Fill&) = delete;
  Fill& operator=(const Fill&) = delete;
  ~Fill() {
    for (sparseblock* block = matrix.blocks; block != nullptr;) {
      sparseblock* next = block->next;
      std::free(block->entries);
      std::free(block->iindices);
      std::free(block->jindices);
      std::free(block);
      block = next;
    }
  }
};

/// CSDP's defaults, as in its manual, without the perturbed objective.
constexpr paramstruc kParameters = {.axtol = 1e-8,
                                    .atytol = 1e-8,
                                    .objtol = 1e-8,
                                    .pinftol = 1e8,
                                    .dinftol = 1e8,
                                    .maxiter = 100,
                                    .minstepfrac = 0.90,
                                    .maxstepfrac = 0.97,
                                    .minstepp = 1e-8,
                                    .minstepd = 1e-8,
                                    .usexzgap = 1,
                                    .tweakgap = 0,
                                    .affine = 0,
                                    .perturbobj = 0,
                                    .fastmode = 0};

/// Runs CSDP from its own type of start; fills X and y (y counted from 1).
int run_csdp(const Problem& problem, Block& X, std::vector<double>& y, Objective& objective) {
  const int n = static_cast<int>(objective.size());
  const int m = static_cast<int>(problem.pairs.size());
  const blockmatrix C = objective.matrix();
  Constraints constraints(problem);

  std::vector<double> a(static_cast<std::size_t>(m) + 1, 0.0);
  std::copy(problem.squared.begin(), problem.squared.end(), a.begin() + 1);
  Block Z(C), Zi(C), dZ(C), dX(C), work1(C), work2(C), work3(C);
  PackedBlock best_X(C), best_Z(C), inverse_of_X(C), inverse_of_Z(C);
  X.values().setIdentity();
  X.values() *= 10.0 * n;
  Z.values().setIdentity();
  Z.values() *= 10.0 * (1.0 + std::max(2.0, objective.size() > 0 ? Fnorm(C) : 0.0)) / std::sqrt(n);

  const auto vector_size = static_cast<std::size_t>(std::max(n, m)) + 1;
  std::vector<std::vector<double>> vectors(14, std::vector<double>(vector_size, 0.0));
  std::size_t next = 0;
  const auto take = [&] { return vectors[next++].data(); };
  double* works[8];
  for (double*& work : works) work = take();
  double* const diagonal = take();
  double* const best_y = take();
  double* const right = take();
  double* const dy = take();
  double* const dy1 = take();
  double* const Fp = take();
  const auto leading = static_cast<std::size_t>(m % 2 == 0 ? m + 1 : m);
  std::vector<double> O(leading * leading);
  sparseblock* by_block[2] = {nullptr, constraints.first()};

  Fill fill;
  makefill(m, C, constraints.heads(), &fill.matrix, *work1, 0);
  sort_entries(m, C, constraints.heads());
  double primal = 0.0;
  double dual = 0.0;
  return sdp(n, m, C, a.data(), 0.0, constraints.heads(), by_block, fill.matrix, *X, y.data(), *Z,
             *inverse_of_X, *inverse_of_Z, &primal, &dual, *work1, *work2, *work3, works[0],
             works[1], works[2], works[3], works[4], works[5], works[6], works[7], diagonal,
             *best_X, best_y, *best_Z, *Zi, O.data(), right, *dZ, *dX, dy, dy1, Fp, 0, kParameters);
}

}  // namespace

CsdpAnswer solve_with_csdp(const Problem& problem) {
  const auto m = std::ssize(problem.pairs);
  if (m < 1 || m > kMostCsdpPairs)
    throw InvalidInput(fmt::format("CSDP takes 1 to {} pairs, got {}", kMostCsdpPairs, m));
  // CSDP, or the LAPACK under it, is not documented as safe to run twice at once.
  static std::mutex alone;
  const std::lock_guard lock(alone);

  Objective objective(problem.mass);
  Block X(objective.matrix());
  std::vector<double> y(problem.pairs.size() + 1, 0.0);
  CsdpAnswer answer;
  answer.code = run_csdp(problem, X, y, objective);

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(X.values());
  Eigen::MatrixXd& Y = answer.solution.Y;
  Y.setZero(problem.points(), X.values().rows());
  Y.bottomRows(X.values().rows()) =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const Eigen::RowVectorXd mean = problem.mass.transpose() * Y / problem.mass.sum();
  Y.rowwise() -= mean;
  answer.solution.solver = SdpSolver::kCsdp;
  answer.solution.w = Eigen::Map<Eigen::VectorXd>(y.data() + 1, m);
  return answer;
}

}  // namespace mapproof::unfolding
