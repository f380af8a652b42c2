#include "rover/quasi_static/linkage_equations.h"

namespace rockyard::rover {
namespace {

constexpr int kShared = 7;  // the coordinates that both sides have

}  // namespace

void LinkageEquations::Reset(const LinkageVector& force, const LinkageVector& diagonal) {
  force_ = force;
  diagonal_ = diagonal;
  for (SideMatrix& stiffness : side_stiffness_) stiffness.setZero();
}

void LinkageEquations::AddForce(std::size_t side, const SideVector& f) {
  force_.head<kShared>() += f.head<kShared>();
  force_[kFirstBogieDof + static_cast<int>(side)] += f[kShared];
}

void LinkageEquations::AddStiffness(std::size_t side, double k, const SideVector& a) {
  side_stiffness_[side] += (k * a).lazyProduct(a.transpose());
}

void LinkageEquations::AddStiffness(std::size_t side, const SideVector& p, const SideVector& a,
                                    const SideVector& q, const SideVector& b, const SideVector& r,
                                    const SideVector& c) {
  // Whole columns, not the lower triangle alone: the processor takes two rows at a time.
  SideMatrix& stiffness = side_stiffness_[side];
  for (int j = 0; j < stiffness.cols(); ++j) stiffness.col(j) += a[j] * p + b[j] * q + c[j] * r;
}

void LinkageEquations::AddAt(int dof, double force, double stiffness) {
  force_[dof] += force;
  diagonal_[dof] += stiffness;
}

// Row 7 of a side is its bogie, which stands in row 7 (left) or 8 (right) of the system. The two
// bogies share no term, so entry (8, 7) is zero. The force is the last entry of each row.
LinkageEquations::Rows LinkageEquations::Augmented() const {
  const auto& [left, right] = side_stiffness_;
  constexpr int kLeft = kFirstBogieDof;
  constexpr int kRight = kFirstBogieDof + 1;
  Rows rows;
  for (int i = 0; i < kShared; ++i) {
    rows[i].head<kShared>() = left.col(i).head<kShared>() + right.col(i).head<kShared>();
    rows[i].tail<3>() << left(kShared, i), right(kShared, i), force_[i];
  }
  rows[kLeft].head<kShared>() = left.col(kShared).head<kShared>();
  rows[kLeft].tail<3>() << left(kShared, kShared), 0.0, force_[kLeft];
  rows[kRight].head<kShared>() = right.col(kShared).head<kShared>();
  rows[kRight].tail<3>() << 0.0, right(kShared, kShared), force_[kRight];
  for (int i = 0; i < kLinkageDof; ++i) rows[i][i] += diagonal_[i];
  return rows;
}

// Gauss's elimination, which needs no pivots as the matrix is positive definite. Whole rows are
// subtracted, zeros as well: loops of one length are faster than half the work in loops of many.
LinkageVector LinkageEquations::Solve() const {
  Rows rows = Augmented();
  LinkageVector inverse;
  for (int j = 0; j < kLinkageDof; ++j) {
    inverse[j] = 1.0 / rows[j][j];
    for (int i = j + 1; i < kLinkageDof; ++i) rows[i] -= rows[i][j] * inverse[j] * rows[j];
  }
  // From the last row up: x_j = (f_j - sum over k > j of U_jk x_k) / U_jj.
  LinkageVector x;
  for (int j = kLinkageDof - 1; j >= 0; --j) {
    double rest = rows[j][kLinkageDof];
    for (int k = j + 1; k < kLinkageDof; ++k) rest -= rows[j][k] * x[k];
    x[j] = rest * inverse[j];
  }
  return x;
}

}  // namespace rockyard::rover
