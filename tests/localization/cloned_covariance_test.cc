#include "localization/cloned_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "core/random.h"

namespace rockyard::localization {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Part = ClonedCovariance::Part;

MatrixXd One(double value) { return MatrixXd::Constant(1, 1, value); }

MatrixXd Random(core::RandomStream& stream, int rows, int columns) {
  return MatrixXd::NullaryExpr(rows, columns, [&] { return stream.Uniform() - 0.5; });
}

MatrixXd RandomCovariance(core::RandomStream& stream, int rows) {
  const MatrixXd root = Random(stream, rows, rows);
  return root * root.transpose() + 0.1 * MatrixXd::Identity(rows, rows);
}

// What the class stands for, without its economy: the state and all clones as one long state.
struct Plain {
  MatrixXd P;
  int n;

  void Propagate(const MatrixXd& F, const MatrixXd& Q) {
    MatrixXd all = MatrixXd::Identity(P.rows(), P.rows());
    all.topLeftCorner(n, n) = F;
    P = (all * P * all.transpose()).eval();
    P.topLeftCorner(n, n) += Q;
  }
  void Clone() {
    MatrixXd copy = MatrixXd::Zero(P.rows() + n, P.rows());
    copy.topRows(P.rows()).setIdentity();
    copy.bottomLeftCorner(n, n).setIdentity();
    P = (copy * P * copy.transpose()).eval();
  }
  VectorXd Update(const MatrixXd& H, const VectorXd& r, const MatrixXd& R) {
    const MatrixXd K = P * H.transpose() * (H * P * H.transpose() + R).inverse();
    P = (P - K * H * P).eval();
    return K * r;
  }
};

// A walk along a line: variance q a metre, a fix of the place at s1 that arrives at s2.
TEST(ClonedCovariance, AFixThatIsLateIsWorthWhatItWasWorth) {
  constexpr double q = 0.01, s1 = 0.5, s2 = 0.7, R = 0.0004;
  ClonedCovariance walk(One(0.0));
  walk.Propagate(One(1.0), One(q * s1));
  walk.Clone(3);
  walk.Propagate(One(1.0), One(q * (s2 - s1)));
  EXPECT_NEAR(walk.With(3)(0, 0), q * s1, 1e-15);
  const std::vector<Part> parts{{3, One(1.0)}};
  const double P1 = q * s1;
  EXPECT_NEAR(walk.MahalanobisSquared(parts, One(0.03), One(R)), 0.0009 / (P1 + R), 1e-12);
  const auto correction = walk.Update(parts, One(0.03), One(R));
  EXPECT_NEAR(correction.changes(0, 0), 0.03 * P1 / (P1 + R), 1e-15);
  EXPECT_NEAR(correction.changes(0, 1), 0.03 * P1 / (P1 + R), 1e-15);
  EXPECT_NEAR(correction.mahalanobis_squared, 0.0009 / (P1 + R), 1e-12);
  EXPECT_NEAR(walk.now()(0, 0), q * s2 - P1 * P1 / (P1 + R), 1e-15);
}

// A measured length corrects what the walk did between its ends, and not what it did before.
TEST(ClonedCovariance, AMotionTellsNothingOfWhatWasBefore) {
  constexpr double q = 0.01, s1 = 0.5, s2 = 0.7, s3 = 1.0, R = 0.0004;
  ClonedCovariance walk(One(0.0));
  walk.Propagate(One(1.0), One(q * s1));
  walk.Clone(1);
  walk.Propagate(One(1.0), One(q * (s2 - s1)));
  walk.Clone(2);
  walk.Propagate(One(1.0), One(q * (s3 - s2)));
  const double d = q * (s2 - s1);
  const auto correction =
      walk.Update(std::vector<Part>{{1, One(-1.0)}, {2, One(1.0)}}, One(0.01), One(R));
  EXPECT_NEAR(correction.changes(0, 0), 0.01 * d / (d + R), 1e-15);
  EXPECT_NEAR(correction.changes(0, 1), 0.0, 1e-15);
  EXPECT_NEAR(correction.changes(0, 2), 0.01 * d / (d + R), 1e-15);
  EXPECT_NEAR(walk.now()(0, 0), q * s3 - d * d / (d + R), 1e-15);
}

TEST(ClonedCovariance, EqualsOneLongState) {
  core::RandomStream stream({5, 0}, core::Purpose::kTest);
  constexpr int n = 3;
  const MatrixXd initial = RandomCovariance(stream, n);
  ClonedCovariance clones(initial);
  Plain plain{initial, n};
  for (int step = 0; step < 4; ++step) {
    const MatrixXd F = MatrixXd::Identity(n, n) + Random(stream, n, n);
    const MatrixXd Q = RandomCovariance(stream, n);
    clones.Propagate(F, Q);
    plain.Propagate(F, Q);
    clones.Clone(10 + step);
    plain.Clone();
    // Of the first clone, the last one and now.
    const MatrixXd first = Random(stream, 2, n), last = Random(stream, 2, n),
                   now = Random(stream, 2, n), R = RandomCovariance(stream, 2);
    const VectorXd r = Random(stream, 2, 1);
    MatrixXd H = MatrixXd::Zero(2, plain.P.rows());
    H.leftCols(n) += now;
    H.middleCols(n, n) += first;
    H.rightCols(n) += last;
    const VectorXd expected = plain.Update(H, r, R);
    const auto correction =
        clones.Update(std::vector<Part>{{std::nullopt, now}, {10, first}, {10 + step, last}}, r, R);
    for (int i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(correction.changes(i % n, i / n), expected[i], 1e-9);
    }
    EXPECT_TRUE(clones.now().isApprox(plain.P.topLeftCorner(n, n), 1e-9));
    EXPECT_TRUE(clones.With(10 + step).isApprox(plain.P.topRightCorner(n, n), 1e-9));
  }
}

// What is left of the matrix is what it was.
TEST(ClonedCovariance, ForgetsOneCloneAndNothingElse) {
  core::RandomStream stream({6, 0}, core::Purpose::kTest);
  ClonedCovariance all(RandomCovariance(stream, 2));
  for (const std::int64_t number : {1, 2, 3}) {
    all.Clone(number);
    all.Propagate(Random(stream, 2, 2), RandomCovariance(stream, 2));
  }
  ClonedCovariance left = all;
  left.Forget(2);
  left.Forget(7);
  EXPECT_EQ(std::vector<std::int64_t>(left.clones().begin(), left.clones().end()),
            (std::vector<std::int64_t>{1, 3}));
  EXPECT_FALSE(left.Has(2));
  EXPECT_EQ(left.now(), all.now());
  EXPECT_EQ(left.With(1), all.With(1));
  EXPECT_EQ(left.With(3), all.With(3));
  const std::vector<Part> parts{{1, Random(stream, 1, 2)}, {3, Random(stream, 1, 2)}};
  const auto with = all.Update(parts, One(0.3), One(0.1));
  const auto without = left.Update(parts, One(0.3), One(0.1));
  EXPECT_TRUE(without.changes.col(0).isApprox(with.changes.col(0), 1e-12));
  EXPECT_TRUE(without.changes.col(1).isApprox(with.changes.col(1), 1e-12));
  EXPECT_TRUE(without.changes.col(2).isApprox(with.changes.col(3), 1e-12));
  EXPECT_TRUE(left.now().isApprox(all.now(), 1e-12));
}

}  // namespace
}  // namespace rockyard::localization
