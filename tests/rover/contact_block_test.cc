// The rows of one contact against Jacobians and the inverse of the mass matrix.
#include "rover/multibody/contact_block.h"

#include <gtest/gtest.h>

#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

// A wheel of a rover that stands level, deep enough in the ground to be pressed, on a slant.
class WheelContact : public testing::Test {
 protected:
  static constexpr double kStep_s = 1.0 / 60.0;
  static constexpr std::size_t kWheel = 4;
  static constexpr int kBody = kFirstWheel + static_cast<int>(kWheel);

  WheelContact() {
    body_.UpdatePoses();
    inertia_.Update(body_);
    part_.kind = truth::BodyPart::kWheel;
    part_.body = kBody;
    contact_.part = static_cast<int>(kWheel);
    contact_.gap_m = -1e-3;
    contact_.n_W = Vector3(0.3, -0.2, 1.0).normalized();
    contact_.along_W = Vector3(1.0, 0.0, -0.3).normalized();
    contact_.across_W = contact_.n_W.cross(contact_.along_W);
    contact_.p_W = body_.X_WB(kBody).translation() + Vector3(0.01, 0.02, -0.065);
    velocity_.head<6>() << 0.1, -0.2, 0.05, 0.03, 0.02, -0.2;
    velocity_[6 + kBody] = 1.5;
    motor_.low = -1e3;
    motor_.high = 1e3;
    motor_.target = 2.0;
    motor_.per_diagonal = 1.0 / inertia_.OfJoint(kBody).Yield();
    law_.stiffness_N_m = 1e5;
    law_.friction = 1e3;
  }

  DofVector Jacobian(int body, const Vector3& p_W, const Vector3& n_W) const {
    DofVector J;
    body_.FillJacobian(body, p_W, n_W, J);
    return J;
  }
  DofVector Along() const { return Jacobian(kBody, contact_.p_W, contact_.along_W); }
  DofVector Across() const { return Jacobian(kBody, contact_.p_W, contact_.across_W); }
  DofVector Drag() const {
    return Jacobian(body_.Parent(kBody), body_.X_WB(kBody).translation(), contact_.along_W);
  }
  // Generalized impulse of what the contact and the motor keep.
  DofVector Impulse() const {
    return contact_.impulse_Ns[0] * Jacobian(kBody, contact_.p_W, contact_.n_W) +
           contact_.impulse_Ns[1] * Along() +
           (contact_.impulse_Ns[2] + contact_.side_Ns) * Across() + contact_.drag_Ns * Drag() +
           motor_.impulse * DofVector::Unit(6 + kBody);
  }
  // Starts from the contact's impulses and relaxes once; returns the velocities after that.
  DofVector Relaxed(LooseRock* rock = nullptr) {
    UnitVelocity z = inertia_.ToUnit(velocity_);
    ContactBlock block;
    block.Start({inertia_, body_, part_, 10.0, kStep_s}, law_, rock, contact_, z);
    block.AddMotor(inertia_.OfJoint(kBody), motor_, 0.065, z);
    block.Relax(laws_, z);
    block.Keep();
    return inertia_.FromUnit(z);
  }

  RoverParams params_;
  Multibody body_{params_};
  JointSpaceInertia inertia_{params_};
  ContactLaws laws_{params_, BekkerSoil()};
  Part part_{};
  Contact contact_;
  ContactLaw law_;
  Bounds motor_;
  DofVector velocity_ = DofVector::Zero();
};

// v = v* + M^-1 J' p, from the impulses of the last step on.
TEST_F(WheelContact, ImpulsesAct) {
  contact_.impulse_Ns = {0.4, 0.1, -0.05};
  contact_.drag_Ns = -0.03;
  contact_.side_Ns = 0.02;
  law_.drag_ratio = 0.1;
  law_.side_ratio = 0.05;
  const DofVector v = Relaxed();
  EXPECT_GT(contact_.impulse_Ns[0], 0.0);
  EXPECT_NE(motor_.impulse, 0.0);
  const DofVector expected = velocity_ + inertia_.Inverse() * Impulse();
  EXPECT_LT((v - expected).norm(), 1e-12 * expected.norm());
}

// Friction that holds stops the contact, while the motor holds its rate.
TEST_F(WheelContact, FrictionAndMotorHoldTogether) {
  const DofVector v = Relaxed();
  EXPECT_NEAR(Along().dot(v), 0.0, 1e-12);
  EXPECT_NEAR(Across().dot(v), 0.0, 1e-12);
  EXPECT_NEAR(v[6 + kBody], 2.0, 1e-11);
}

TEST_F(WheelContact, AStalledMotorLeavesTheWheelToFriction) {
  motor_.low = -1e-3;
  motor_.high = 1e-3;
  const DofVector v = Relaxed();
  EXPECT_EQ(std::abs(motor_.impulse), 1e-3);
  EXPECT_NEAR(Along().dot(v), 0.0, 1e-12);
  EXPECT_NEAR(Across().dot(v), 0.0, 1e-12);
}

// The resistance comes after friction and knows what that did, also where it slides.
TEST_F(WheelContact, ResistanceStopsTheAxleAfterFriction) {
  law_.friction = 0.1;
  law_.drag_ratio = 1e3;
  const DofVector v = Relaxed();
  EXPECT_NEAR(Drag().dot(v), 0.0, 1e-12);
  EXPECT_NEAR(std::hypot(contact_.impulse_Ns[1], contact_.impulse_Ns[2]),
              0.1 * contact_.impulse_Ns[0], 1e-9);
}

// And so does the side face after both.
TEST_F(WheelContact, TheSideFaceStopsTheWheelLast) {
  law_.friction = 0.1;
  law_.drag_ratio = 0.2;
  law_.side_ratio = 1e3;
  const DofVector v = Relaxed();
  EXPECT_NEAR(Across().dot(v), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(contact_.drag_Ns), 0.2 * contact_.impulse_Ns[0], 1e-12);
}

// The normal comes first: alone, without friction, its spring and damper are satisfied.
TEST_F(WheelContact, TheNormalFollowsItsSpring) {
  law_.friction = 0.0;
  motor_.low = motor_.high = 0.0;
  const DofVector v = Relaxed();
  const double slope = kStep_s * law_.stiffness_N_m + 10.0;
  EXPECT_NEAR(Jacobian(kBody, contact_.p_W, contact_.n_W).dot(v) +
                  contact_.impulse_Ns[0] / (kStep_s * slope),
              law_.stiffness_N_m * 1e-3 / slope, 1e-12);
}

// A rock that slides: the contact stops against it.
TEST_F(WheelContact, FrictionHoldsAgainstAMovingRock) {
  LooseRock rock{.mass_kg = 0.5, .v_W_m_s = Vector3(0.05, -0.1, 0.0)};
  const Vector3 before = rock.v_W_m_s;
  const DofVector v = Relaxed(&rock);
  EXPECT_NEAR(Along().dot(v), contact_.along_W.dot(rock.v_W_m_s), 1e-12);
  EXPECT_NEAR(Across().dot(v), contact_.across_W.dot(rock.v_W_m_s), 1e-12);
  const Vector3 impulse = contact_.impulse_Ns[0] * contact_.n_W +
                          contact_.impulse_Ns[1] * contact_.along_W +
                          contact_.impulse_Ns[2] * contact_.across_W;
  EXPECT_LT((rock.mass_kg * (rock.v_W_m_s - before) + impulse).head<2>().norm(), 1e-13);
}

}  // namespace
}  // namespace rockyard::rover
