// What the error-state filter is made of: its gate, its covariance of clones, and the growth of
// errors over a stretch.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "localization/aid_fixes.h"
#include "localization/cloned_covariance.h"
#include "localization/error_stretch.h"
#include "math/angles.h"

namespace rockyard::localization {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Chi-squared quantiles of 0.999: 10.828, 13.816, 16.266, 18.467, 20.515, 22.458 (tables).
TEST(Gate, LetsInWhatAChiSquaredNumberHardlyExceeds) {
  constexpr double kLimits[] = {10.828, 13.816, 16.266, 18.467, 20.515, 22.458};
  for (int values = 1; values <= 6; ++values) {
    const double limit = kLimits[values - 1];
    EXPECT_EQ(Gate({.chance = 1e-3, .patience = 0}).Ask(limit - 0.001, values), GateAnswer::kIn);
    EXPECT_EQ(Gate({.chance = 1e-3, .patience = 0}).Ask(limit + 0.001, values), GateAnswer::kOut);
  }
}

TEST(Gate, TurnsNothingAwayWithoutChance) {
  EXPECT_EQ(Gate({.chance = 0.0, .patience = 1}).Ask(1e30, 1), GateAnswer::kIn);
}

TEST(Gate, DoubtsItselfAfterAsManyInARow) {
  Gate gate({.chance = 1e-3, .patience = 3});
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kDoubtYourself);
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);  // counted anew
  EXPECT_EQ(gate.Ask(1.0, 2), GateAnswer::kIn);     // no longer in a row
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
  gate.Restart();
  EXPECT_EQ(gate.Ask(100.0, 2), GateAnswer::kOut);
}

TEST(Gate, NeverDoubtsItselfWithoutPatience) {
  Gate gate({.chance = 1e-3, .patience = 0});
  for (int i = 0; i < 20; ++i) EXPECT_EQ(gate.Ask(100.0, 1), GateAnswer::kOut);
}

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

// The growth of errors over a stretch, against differences of two dead reckonings and closed forms.

// What is believed of one drive: a pose and how its sensors are read.
struct Rover {
  double x = 0.3, y = -0.2, z = 0.0, heading = 0.4, pitch = 0.1;
  double bias = 0.01, gyro_scale = 0.95, wheel_scale = 1.03, pan = 0.0;

  MotionTick Believed(double wheels_m, double gyro_rad, double share, double duration_s) const {
    const double turn = (gyro_rad - bias * duration_s) / gyro_scale;
    return {.forward_m = wheels_m * wheel_scale,
            .turn_rad = turn,
            .along_rad = heading + share * turn,
            .turn_share = share,
            .pitch_rad = pitch,
            .duration_s = duration_s,
            .gyro_scale = gyro_scale,
            .wheel_scale = wheel_scale};
  }
  void Drive(const MotionTick& tick) {
    x += tick.forward_m * std::cos(tick.along_rad);
    y += tick.forward_m * std::sin(tick.along_rad);
    z -= tick.forward_m * std::sin(pitch);
    heading += tick.turn_rad;
  }
  ErrorVector Values() const {
    ErrorVector values;
    values << x, y, z, 0.0, pitch, heading, bias, gyro_scale, wheel_scale, pan;
    return values;
  }
  // Off by `step` in one row of the error.
  Rover Off(error::Row row, double step) const {
    Rover off = *this;
    if (row == error::kX) off.x += step;
    if (row == error::kY) off.y += step;
    if (row == error::kZ) off.z += step;
    if (row == error::kPitch) off.pitch += step;
    if (row == error::kHeading) off.heading += step;
    if (row == error::kGyroBias) off.bias += step;
    if (row == error::kGyroScale) off.gyro_scale += step;
    if (row == error::kWheelScale) off.wheel_scale += step;
    if (row == error::kPan) off.pan += step;
    return off;
  }
};

ErrorVector DriveCurve(Rover rover, double share, ErrorStretch* stretch = nullptr) {
  for (int i = 0; i < 40; ++i) {
    const double gyro_rad = i < 20 ? 0.02 : -0.03;
    const double wheels_m = i % 10 == 9 ? -0.002 : 0.0035;
    const MotionTick tick = rover.Believed(wheels_m, gyro_rad, share, 0.05);
    if (stretch != nullptr) stretch->Add(tick, {.tilt_kept = 1.0});
    rover.Drive(tick);
  }
  return rover.Values();
}

TEST(ErrorStretch, CarriesEveryErrorOnAsDeadReckoningDoes) {
  constexpr double kStep = 1e-6;
  for (const double share : {0.5, 0.0}) {
    ErrorStretch stretch;
    DriveCurve(Rover{}, share, &stretch);
    for (const error::Row row :
         {error::kX, error::kY, error::kZ, error::kPitch, error::kHeading, error::kGyroBias,
          error::kGyroScale, error::kWheelScale, error::kPan}) {
      const ErrorVector difference = (DriveCurve(Rover{}.Off(row, kStep), share) -
                                      DriveCurve(Rover{}.Off(row, -kStep), share)) /
                                     (2.0 * kStep);
      const ErrorVector column = stretch.transition().col(row);
      EXPECT_LT((column - difference).cwiseAbs().maxCoeff(), 1e-7) << "row " << row;
    }
    EXPECT_NEAR(stretch.way_m(), 1.03 * (36 * 0.0035 + 4 * 0.002), 1e-12);
  }
}

// Heading noise of q a metre, integrated twice: the variance across is q L^3 / 3, the covariance
// with the heading q L^2 / 2; that of the distance grows with the way.
TEST(ErrorStretch, GrowsAsTheClosedFormOfAStraightDrive) {
  constexpr double kLength_m = 10.0;
  constexpr int kTicks = 20000;
  const double q = 0.70 * math::DegToRad(1.0) * math::DegToRad(1.0);
  const double step_m = kLength_m / kTicks;
  ErrorStretch stretch;
  for (int i = 0; i < kTicks; ++i) {
    stretch.Add(
        {.forward_m = step_m, .along_rad = 0.0, .duration_s = 0.05},
        {.heading_rad2 = q * step_m, .distance_m2 = 0.0039 * step_m, .height_m2 = 1e-4 * step_m});
  }
  const ErrorMatrix& N = stretch.noise();
  EXPECT_NEAR(N(error::kHeading, error::kHeading), q * kLength_m, 1e-12);
  EXPECT_NEAR(N(error::kY, error::kY), q * std::pow(kLength_m, 3) / 3.0, 1e-5);
  EXPECT_NEAR(N(error::kY, error::kHeading), q * kLength_m * kLength_m / 2.0, 1e-6);
  EXPECT_NEAR(N(error::kX, error::kX), 0.0039 * kLength_m, 1e-12);
  EXPECT_NEAR(N(error::kZ, error::kZ), 1e-4 * kLength_m, 1e-12);
  EXPECT_NEAR(std::sqrt(N(error::kY, error::kY)), 0.267, 0.001);  // Matthies 1995, figure 6a
}

// A bias that walks is a heading whose rate walks: variances r T, r T^3 / 3, covariance -r T^2 / 2.
TEST(ErrorStretch, TurnsTheWalkOfTheBiasIntoHeading) {
  constexpr double kRate = 1e-8;  // rad2/s2 a second
  constexpr int kTicks = 10000;
  constexpr double kTick_s = 0.01;
  ErrorStretch stretch;
  for (int i = 0; i < kTicks; ++i) {
    stretch.Add({.duration_s = kTick_s}, {.bias_rad2_s2 = kRate * kTick_s});
  }
  const double T = kTicks * kTick_s;
  const ErrorMatrix& N = stretch.noise();
  EXPECT_NEAR(N(error::kGyroBias, error::kGyroBias) / (kRate * T), 1.0, 1e-9);
  EXPECT_NEAR(N(error::kHeading, error::kHeading) / (kRate * T * T * T / 3.0), 1.0, 1e-3);
  EXPECT_NEAR(N(error::kHeading, error::kGyroBias) / (-kRate * T * T / 2.0), 1.0, 1e-3);
}

// Half of a tick's turn is in its own step: noise of one tick alone.
TEST(ErrorStretch, PutsAShareOfATicksNoiseIntoItsOwnStep) {
  ErrorStretch stretch;
  stretch.Add({.forward_m = 2.0, .along_rad = 0.0, .turn_share = 0.5}, {.heading_rad2 = 0.01});
  EXPECT_NEAR(stretch.noise()(error::kY, error::kY), 0.01, 1e-15);
  EXPECT_NEAR(stretch.noise()(error::kY, error::kHeading), 0.01, 1e-15);
  ErrorStretch across;
  across.Add({.forward_m = 1.0, .along_rad = math::DegToRad(90.0)}, {.distance_m2 = 0.04});
  EXPECT_NEAR(across.noise()(error::kY, error::kY), 0.04, 1e-15);
  EXPECT_NEAR(across.noise()(error::kX, error::kX), 0.0, 1e-15);
  ErrorStretch oblique;
  oblique.Add({.forward_m = 1.0, .along_rad = math::DegToRad(45.0)}, {.distance_m2 = 0.04});
  EXPECT_NEAR(oblique.noise()(error::kX, error::kY), 0.02, 1e-15);
  EXPECT_NEAR(oblique.noise()(error::kY, error::kX), 0.02, 1e-15);
}

// The tilt's error forgets itself and stays as large as it is.
TEST(ErrorStretch, KeepsTheTiltsErrorStationary) {
  constexpr double kVariance = 4e-4;
  ErrorStretch stretch;
  for (int i = 0; i < 50; ++i) {
    stretch.Add({.forward_m = 0.0}, {.tilt_kept = 0.9, .tilt_rad2 = kVariance});
  }
  const double kept = std::pow(0.9, 50);
  for (const error::Row row : {error::kRoll, error::kPitch}) {
    EXPECT_NEAR(stretch.transition()(row, row), kept, 1e-12);
    EXPECT_NEAR(stretch.noise()(row, row), kVariance * (1.0 - kept * kept), 1e-12);
  }
}

TEST(ErrorStretch, BeginsAnew) {
  ErrorStretch stretch;
  EXPECT_TRUE(stretch.empty());
  stretch.Add({.forward_m = -1.0}, {.distance_m2 = 1.0});
  EXPECT_FALSE(stretch.empty());
  EXPECT_EQ(stretch.way_m(), 1.0);
  stretch.Restart();
  EXPECT_TRUE(stretch.empty());
  EXPECT_EQ(stretch.way_m(), 0.0);
  EXPECT_EQ(stretch.transition(), ErrorMatrix::Identity());
  EXPECT_EQ(stretch.noise(), ErrorMatrix::Zero());
}

}  // namespace
}  // namespace rockyard::localization
