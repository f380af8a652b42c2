// The two friction rows of one contact, solved together.
#pragma once

#include <array>

namespace rockyard::rover {

// Finds impulses p = (p0, p1) with |p| <= most for which the velocity that remains at the contact,
// A p - b, is -c p or, where the bound holds p back, faster and still exactly opposite to p:
// Coulomb's law with the principle of largest dissipation. A, symmetric and positive definite, is
// the velocity that a unit impulse causes at the contact, and c >= 0 how it yields to impulses
// within the bound. Taking the rows one by one, or each with its own diagonal, would turn sliding
// friction away from the direction of sliding.
class FrictionBlock {
 public:
  // Sets A = [a0 a01; a01 a1] and forgets s.
  void Set(double a0, double a1, double a01);

  // Returns p. (A + s I) p = b holds for s = c within the bound, or for the s > c that gives
  // |p| = most, found by Newton's method on the length of p (More and Sorensen 1983 sec. 3), which
  // approaches s from below without overshoot. It starts from the s of the last call: one or two
  // iterations within the sweeps of one step.
  std::array<double, 2> Solve(const std::array<double, 2>& b, double softness, double most);

  double a0() const { return a0_; }
  double a1() const { return a1_; }
  double a01() const { return a01_; }

 private:
  std::array<double, 2> SolveShifted(const std::array<double, 2>& b) const;

  double a0_ = 1.0;
  double a1_ = 1.0;
  double a01_ = 0.0;
  double shift_ = 0.0;
};

}  // namespace rockyard::rover
