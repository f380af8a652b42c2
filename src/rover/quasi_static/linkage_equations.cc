#include "rover/quasi_static/linkage_equations.h"

namespace rockyard::rover {
namespace {

constexpr int kShared = 7;  // the coordinates that both sides have

}  // namespace

void LinkageEquations::Reset(const LinkageVector& force, const LinkageVector& diagonal) {
  force_ = force;
  for (std::size_t i = 0; i < stiffness_.size(); ++i) {
    stiffness_[i].fill(0.0);
    stiffness_[i][i] = diagonal[static_cast<int>(i)];
  }
}

void LinkageEquations::AddForce(std::size_t side, const SideVector& f) {
  force_.head<kShared>() += f.head<kShared>();
  force_[kFirstBogieDof + static_cast<int>(side)] += f[kShared];
}

void LinkageEquations::AddStiffness(std::size_t side, double k, const SideVector& a) {
  // Row 7 of a side's vectors is its bogie, which stands in row 7 (left) or 8 (right) of the
  // system. The two bogies share no term, so entry (8, 7) stays zero.
  for (int i = 0; i < kShared; ++i) {
    for (int j = 0; j <= i; ++j) stiffness_[i][j] += k * a[i] * a[j];
  }
  const std::size_t bogie = kFirstBogieDof + side;
  // The bogie's row of k a a'.
  for (int j = 0; j < kShared; ++j) stiffness_[bogie][j] += k * a[kShared] * a[j];
  stiffness_[bogie][bogie] += k * a[kShared] * a[kShared];
}

void LinkageEquations::AddStiffness(std::size_t side, const SideVector& p, const SideVector& a,
                                    const SideVector& q, const SideVector& b, const SideVector& r,
                                    const SideVector& c) {
  const auto term = [&](int i, int j) { return p[i] * a[j] + q[i] * b[j] + r[i] * c[j]; };
  for (int i = 0; i < kShared; ++i) {
    for (int j = 0; j <= i; ++j) stiffness_[i][j] += term(i, j);
  }
  const std::size_t bogie = kFirstBogieDof + side;
  for (int j = 0; j < kShared; ++j) stiffness_[bogie][j] += term(kShared, j);
  stiffness_[bogie][bogie] += term(kShared, kShared);
}

void LinkageEquations::AddAt(int dof, double force, double stiffness) {
  force_[dof] += force;
  stiffness_[static_cast<std::size_t>(dof)][static_cast<std::size_t>(dof)] += stiffness;
}

// L D L' without roots, column by column, each taken off the rows below at once: the inner loop has
// no reduction.
LinkageVector LinkageEquations::Solve() const {
  Rows L = stiffness_;
  LinkageVector x = force_;
  std::array<double, kLinkageDof> column{};
  std::array<double, kLinkageDof> inverse{};
  // Forward: column j of L is column j of the remainder over its diagonal d_j; the remainder loses
  // L_j d_j L_j', and the right side goes along, x = L^-1 f.
  for (int j = 0; j < kLinkageDof; ++j) {
    inverse[j] = 1.0 / L[j][j];
    for (int i = j + 1; i < kLinkageDof; ++i) {
      column[i] = L[i][j];
      L[i][j] *= inverse[j];
      x[i] -= L[i][j] * x[j];
    }
    for (int i = j + 1; i < kLinkageDof; ++i) {
      for (int k = j + 1; k <= i; ++k) L[i][k] -= L[i][j] * column[k];
    }
  }
  // Then D^-1, then L'^-1 from the last row up.
  for (int j = 0; j < kLinkageDof; ++j) x[j] *= inverse[j];
  for (int j = kLinkageDof - 1; j >= 0; --j) {
    for (int i = 0; i < j; ++i) x[i] -= L[j][i] * x[j];
  }
  return x;
}

}  // namespace rockyard::rover
