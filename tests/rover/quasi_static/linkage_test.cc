// Velocities of points of the linkage against what their places do, and the small system of a
// balance against its whole matrix.
#include "rover/quasi_static/linkage.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>

#include "rover/random_numbers.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

LinkageVector RandomVector(Numbers& numbers) {
  return LinkageVector::NullaryExpr([&] { return numbers.Next(); });
}

// Central differences over rates of +-1 for a ten-thousandth of a second.
TEST(Linkage, PointsMoveAsTheirPlacesDo) {
  constexpr double kStep_s = 1e-4;
  Linkage linkage{RoverParams{}};
  const messages::PerWheel<double> steer_rad{0.3, 0.0, -0.2, 0.1, 0.0, 0.4};
  for (std::uint32_t i = 0; i < 50; ++i) {
    Numbers numbers(i);
    const Posture posture = Moved({}, RandomVector(numbers), 0.3);
    const LinkageVector rates = RandomVector(numbers);
    const Vector3 p_B = 0.2 * Vector3(numbers.Next(), numbers.Next(), numbers.Next());
    for (int body = kChassis; body < kJoints; ++body) {
      const auto place = [&](double time_s) -> Vector3 {
        linkage.Update(Moved(posture, rates, time_s), steer_rad);
        return linkage.body(body).p_WB + linkage.body(body).R_WB * p_B;
      };
      const Vector3 v = (place(kStep_s) - place(-kStep_s)) / (2.0 * kStep_s);
      const PointMotion motion = linkage.MotionOf(body, place(0.0));
      SideVector of_side;
      of_side << rates.head<7>(), rates[kFirstBogieDof + static_cast<int>(Linkage::SideOf(body))];
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(motion.Along(Vector3::Unit(axis)).dot(of_side), v[axis], 1e-7)
            << i << ", body " << body;
      }
    }
  }
}

TEST(LinkageEquations, SolveTheWholeMatrix) {
  for (std::uint32_t i = 0; i < 50; ++i) {
    Numbers numbers(100 + i);
    LinkageVector force = RandomVector(numbers);
    LinkageVector diagonal = RandomVector(numbers).cwiseAbs2() + LinkageVector::Constant(0.01);
    LinkageEquations equations;
    equations.Reset(force, diagonal);
    Eigen::Matrix<double, kLinkageDof, kLinkageDof> K = diagonal.asDiagonal();
    for (std::size_t contact = 0; contact < 7; ++contact) {
      const std::size_t side = contact % 2;
      const SideVectors A = SideVectors::NullaryExpr([&] { return numbers.Next(); });
      const SideVectors P = A * Eigen::Vector4d(3.0, 0.5, 0.2, 0.0).asDiagonal();
      const SideVector f = SideVector::NullaryExpr([&] { return numbers.Next(); });
      equations.AddStiffness(side, P, A);
      equations.AddForce(side, f);
      // The side's eight rates among the nine.
      const std::array of_side{0, 1, 2, 3, 4, 5, 6, kFirstBogieDof + static_cast<int>(side)};
      K(of_side, of_side) += P.lazyProduct(A.transpose());
      force(of_side) += f;
    }
    equations.AddAt(kRockerDof, 0.7, 2.0);
    force[kRockerDof] += 0.7;
    K(kRockerDof, kRockerDof) += 2.0;
    EXPECT_LT((equations.force() - force).norm(), 1e-14);
    const LinkageVector expected = Eigen::MatrixXd(K).llt().solve(force);
    EXPECT_LT((equations.Solve() - expected).norm(), 1e-11 * expected.norm()) << i;
  }
}

}  // namespace
}  // namespace rockyard::rover
