// Force and its derivative in the rates of the linkage: a symmetric, positive definite system.
#pragma once

#include <array>

#include "rover/quasi_static/linkage.h"

namespace rockyard::rover {

// Sums the force on the linkage and minus its derivative by the rates, from terms that act in the
// space of one side's rates.
class LinkageEquations {
 public:
  // Begins with a force and with a diagonal as minus its derivative.
  void Reset(const LinkageVector& force, const LinkageVector& diagonal);

  // Adds a force that acts on one side's rates.
  void AddForce(std::size_t side, const SideVector& f);
  // Adds k a a'.
  void AddStiffness(std::size_t side, double k, const SideVector& a);
  // Adds p a' + q b' + r c', a symmetric sum.
  void AddStiffness(std::size_t side, const SideVector& p, const SideVector& a, const SideVector& q,
                    const SideVector& b, const SideVector& r, const SideVector& c);
  // Adds a force and its stiffness to one coordinate.
  void AddAt(int dof, double force, double stiffness);

  const LinkageVector& force() const { return force_; }
  // Returns the change of the rates at which the linearized force vanishes, by elimination.
  // A call costs about 0.1 us.
  LinkageVector Solve() const;

 private:
  using SideMatrix = Eigen::Matrix<double, 8, 8>;
  using Rows = std::array<Eigen::Matrix<double, kLinkageDof + 1, 1>, kLinkageDof>;

  Rows Augmented() const;

  LinkageVector force_;
  LinkageVector diagonal_;
  std::array<SideMatrix, 2> side_stiffness_;
};

}  // namespace rockyard::rover
