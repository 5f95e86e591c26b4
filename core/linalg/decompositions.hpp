#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

// Eigen's dense decompositions, compiled once, in the sources *_decompositions.cpp: each takes
// seconds to compile. Include this header where one of them is used. A decomposition of an
// expression, or of a right side that is one, is compiled where it stands: evaluate the expression
// into a matrix first. Not so a transposed one, which is solved by rows, with other last digits.
// An instantiated class lacks its member templates, which follow it.
#define MAPPROOF_SQUARE_DECOMPOSITIONS(TEMPLATE)                                                   \
  TEMPLATE class Eigen::LLT<Eigen::MatrixXd>;                                                      \
  TEMPLATE Eigen::LLT<Eigen::MatrixXd>& Eigen::LLT<Eigen::MatrixXd>::compute(                      \
      const Eigen::EigenBase<Eigen::MatrixXd>&);                                                   \
  TEMPLATE void Eigen::LLT<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&, Eigen::MatrixXd&) \
      const;                                                                                       \
  TEMPLATE void Eigen::LLT<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&, Eigen::VectorXd&) \
      const;                                                                                       \
  TEMPLATE class Eigen::LLT<Eigen::Matrix3d>;                                                      \
  TEMPLATE Eigen::LLT<Eigen::Matrix3d>& Eigen::LLT<Eigen::Matrix3d>::compute(                      \
      const Eigen::EigenBase<Eigen::Matrix3d>&);                                                   \
  TEMPLATE class Eigen::LDLT<Eigen::Matrix3d>;                                                     \
  TEMPLATE Eigen::LDLT<Eigen::Matrix3d>& Eigen::LDLT<Eigen::Matrix3d>::compute(                    \
      const Eigen::EigenBase<Eigen::Matrix3d>&);                                                   \
  TEMPLATE void Eigen::LDLT<Eigen::Matrix3d>::_solve_impl(const Eigen::Vector3d&,                  \
                                                          Eigen::Vector3d&) const;                 \
  TEMPLATE class Eigen::LDLT<Eigen::Matrix4d>;                                                     \
  TEMPLATE Eigen::LDLT<Eigen::Matrix4d>& Eigen::LDLT<Eigen::Matrix4d>::compute(                    \
      const Eigen::EigenBase<Eigen::Matrix4d>&);                                                   \
  TEMPLATE void Eigen::LDLT<Eigen::Matrix4d>::_solve_impl(const Eigen::Vector4d&,                  \
                                                          Eigen::Vector4d&) const;                 \
  TEMPLATE class Eigen::PartialPivLU<Eigen::MatrixXd>;                                             \
  TEMPLATE Eigen::PartialPivLU<Eigen::MatrixXd>::PartialPivLU(                                     \
      const Eigen::EigenBase<Eigen::MatrixXd>&);                                                   \
  TEMPLATE class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;                                   \
  TEMPLATE Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&                                         \
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(                                         \
      const Eigen::EigenBase<Eigen::MatrixXd>&, int);                                              \
  TEMPLATE class Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>;                                   \
  TEMPLATE Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>&                                         \
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>::compute(                                         \
      const Eigen::EigenBase<Eigen::Matrix2d>&, int);

#define MAPPROOF_ORTHOGONAL_DECOMPOSITIONS(TEMPLATE)                                               \
  TEMPLATE class Eigen::HouseholderQR<Eigen::MatrixXd>;                                            \
  TEMPLATE void Eigen::HouseholderQR<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&,         \
                                                                   Eigen::MatrixXd&) const;        \
  TEMPLATE void Eigen::HouseholderQR<Eigen::MatrixXd>::_solve_impl(const Eigen::VectorXd&,         \
                                                                   Eigen::VectorXd&) const;        \
  TEMPLATE class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;                                      \
  TEMPLATE void Eigen::ColPivHouseholderQR<Eigen::MatrixXd>::_solve_impl(const Eigen::MatrixXd&,   \
                                                                         Eigen::MatrixXd&) const;  \
  TEMPLATE class Eigen::ColPivHouseholderQR<Eigen::MatrixX3d>;                                     \
  TEMPLATE void Eigen::ColPivHouseholderQR<Eigen::MatrixX3d>::_solve_impl(const Eigen::MatrixXd&,  \
                                                                          Eigen::MatrixXd&) const; \
  TEMPLATE class Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;                          \
  TEMPLATE void Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>::_solve_impl(              \
      const Eigen::VectorXd&, Eigen::VectorXd&) const;

#define MAPPROOF_SINGULAR_VALUE_DECOMPOSITIONS(TEMPLATE)                        \
  TEMPLATE class Eigen::JacobiSVD<Eigen::MatrixXd>;                             \
  TEMPLATE void Eigen::SVDBase<Eigen::JacobiSVD<Eigen::MatrixXd>>::_solve_impl( \
      const Eigen::MatrixXd&, Eigen::MatrixXd&) const;                          \
  TEMPLATE class Eigen::BDCSVD<Eigen::MatrixXd>;

MAPPROOF_SQUARE_DECOMPOSITIONS(extern template)
MAPPROOF_ORTHOGONAL_DECOMPOSITIONS(extern template)
MAPPROOF_SINGULAR_VALUE_DECOMPOSITIONS(extern template)

namespace mapproof {

/// The first columns of an orthogonal matrix that is kept as reflections, as in a QR decomposition.
Eigen::MatrixXd leading_columns(
    const Eigen::HouseholderSequence<Eigen::MatrixXd, Eigen::VectorXd>& Q, Eigen::Index columns);

}  // namespace mapproof
