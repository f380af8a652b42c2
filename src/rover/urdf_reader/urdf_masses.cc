// Masses of a rover from its URDF file (urdf_draft.h): each of rockyard's bodies has what its links
// and all that they carry have together.
#include <fmt/format.h>

#include <array>
#include <optional>
#include <vector>

#include "rover/multibody/multibody.h"
#include "rover/rover_layout_params.h"
#include "rover/urdf_reader/urdf_draft.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using messages::kWheelCount;

// From here on an inertia that differs from that of rockyard's shapes is named, as a share.
constexpr double kNamedInertia = 0.01;

// Mass, centre and inertia about it, of several links together.
struct UrdfBodyMass {
  double mass_kg = 0.0;
  Vector3 com_R = Vector3::Zero();
  Eigen::Matrix3d inertia_R_kg_m2 = Eigen::Matrix3d::Zero();
  std::string place;  // of the first link that has mass
};

// By body, the chassis first.
using UrdfBodyMasses = std::array<UrdfBodyMass, kJoints + 1>;

std::size_t IndexOf(int body) { return static_cast<std::size_t>(body - kChassis); }

math::Transform ComOf(const UrdfDraft& draft, std::size_t link) {
  math::Transform X_RI = draft.skeleton.X_0L[link] * draft.model.links[link].inertial.X_LI;
  X_RI.translation() -= draft.skeleton.p_0R;
  return X_RI;
}

UrdfBodyMasses SumLinks(const UrdfDraft& draft) {
  UrdfBodyMasses sums;
  for (std::size_t i = 0; i < draft.model.links.size(); ++i) {
    const UrdfLink& link = draft.model.links[i];
    UrdfBodyMass& sum = sums[IndexOf(draft.skeleton.body[i])];
    if (link.inertial.mass_kg == 0.0) continue;
    if (sum.mass_kg == 0.0) sum.place = link.place;
    sum.mass_kg += link.inertial.mass_kg;
    sum.com_R += link.inertial.mass_kg * ComOf(draft, i).translation();
  }
  for (UrdfBodyMass& sum : sums) {
    if (sum.mass_kg > 0.0) sum.com_R /= sum.mass_kg;
  }
  for (std::size_t i = 0; i < draft.model.links.size(); ++i) {
    const UrdfInertial& inertial = draft.model.links[i].inertial;
    UrdfBodyMass& sum = sums[IndexOf(draft.skeleton.body[i])];
    const math::Transform X_RI = ComOf(draft, i);
    // Steiner: I = R I' R^T + m (d^2 1 - d d^T), d from the common centre.
    const Vector3 d = X_RI.translation() - sum.com_R;
    sum.inertia_R_kg_m2 +=
        X_RI.linear() * inertial.inertia_I_kg_m2 * X_RI.linear().transpose() +
        inertial.mass_kg * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
  }
  return sums;
}

// Names a centre of mass that is not where rockyard has it.
void NameCom(UrdfDraft& draft, const UrdfBodyMass& sum, std::string_view where,
             const Vector3& off) {
  if (sum.mass_kg == 0.0 || off.norm() <= kSameLength_m) return;
  draft.findings.NotTaken(sum.place,
                          fmt::format("has its centre of mass, with what it carries, "
                                      "({:.4f}, {:.4f}, {:.4f}) m off {}, where rockyard has it",
                                      off.x(), off.y(), off.z(), where));
}

// Names the moments of bodies that rockyard has alike, once: those that are farthest off.
void NameInertia(UrdfDraft& draft, const std::vector<const UrdfBodyMass*>& alike,
                 std::string_view as, const BodyMass& rover) {
  const Eigen::Matrix3d rover_I = rover.inertia_kg_m2.asDiagonal();
  const UrdfBodyMass* worst = nullptr;
  double most = kNamedInertia * rover_I.maxCoeff();
  for (const UrdfBodyMass* sum : alike) {
    if (sum->inertia_R_kg_m2.isZero(0.0)) continue;  // told by nobody
    const double off = (sum->inertia_R_kg_m2 - rover_I).cwiseAbs().maxCoeff();
    if (off <= most) continue;
    most = off;
    worst = sum;
  }
  if (worst == nullptr) return;
  const Vector3 file_I = worst->inertia_R_kg_m2.diagonal();
  draft.findings.NotTaken(
      worst->place,
      fmt::format("has with what it carries moments of inertia of ({:.3g}, {:.3g}, {:.3g}) kg m2: "
                  "rockyard takes those of {}, ({:.3g}, {:.3g}, {:.3g}){}",
                  file_I.x(), file_I.y(), file_I.z(), as, rover.inertia_kg_m2.x(),
                  rover.inertia_kg_m2.y(), rover.inertia_kg_m2.z(),
                  alike.size() > 1 ? ", for all that are alike" : ""));
}

// Carries the mass of several bodies that are alike; those without mass tell nothing.
void CarryMass(UrdfDraft& draft, const UrdfBodyMasses& sums, std::string_view path, double& field,
               int first, int end) {
  std::vector<ToldValue> told;
  for (int body = first; body < end; ++body) {
    const UrdfBodyMass& sum = sums[IndexOf(body)];
    if (sum.mass_kg > 0.0) told.push_back({TwelveDigits(sum.mass_kg), sum.place});
  }
  draft.CarryAgreed(path, field, told, told.empty() ? 0.0 : kSameShare * told.front().value);
}

void NameMasses(UrdfDraft& draft, const UrdfBodyMasses& sums) {
  const UrdfSkeleton& skeleton = draft.skeleton;
  const RoverMasses masses = MakeRoverMasses(draft.params);
  const UrdfBodyMass& chassis = sums[IndexOf(kChassis)];
  NameCom(draft, chassis, "the middle plane", {0.0, chassis.com_R.y(), 0.0});
  NameInertia(draft, {&chassis}, "a solid box", masses.chassis);
  // Along its axis a pivot is anywhere.
  const auto name_arms = [&](int first, const std::array<std::optional<std::size_t>, 2>& joints,
                             const BodyMass& rover) {
    std::vector<const UrdfBodyMass*> arms;
    for (std::size_t side = 0; side < 2; ++side) {
      if (!joints[side]) continue;
      const UrdfBodyMass& arm = *arms.emplace_back(&sums[IndexOf(first) + side]);
      Vector3 off = arm.com_R - skeleton.p_RJ(draft.model, *joints[side]);
      off.y() = 0.0;
      NameCom(draft, arm, "its pivot", off);
    }
    NameInertia(draft, arms, "a flat bar", rover);
  };
  name_arms(kLeftRocker, skeleton.rocker, masses.rocker);
  name_arms(kLeftBogie, {skeleton.bogie[0], skeleton.bogie[1]}, masses.bogie);
  std::vector<const UrdfBodyMass*> wheels;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const UrdfBodyMass& wheel = *wheels.emplace_back(&sums[IndexOf(kFirstWheel) + i]);
    NameCom(draft, wheel, "the wheel's centre", wheel.com_R - draft.p_RWheel(i));
  }
  NameInertia(draft, wheels, "a solid cylinder", masses.wheel);
}

}  // namespace

void ReadUrdfMasses(UrdfDraft& draft) {
  const UrdfBodyMasses sums = SumLinks(draft);
  RoverMassParams& mass = draft.params.mass;
  double total_kg = 0.0;
  for (const UrdfBodyMass& sum : sums) total_kg += sum.mass_kg;
  const UrdfBodyMass& chassis = sums[IndexOf(kChassis)];
  if (total_kg > 0.0) {
    draft.Carry("mass.total_kg", mass.total_kg, TwelveDigits(total_kg),
                draft.model.links[draft.skeleton.chassis].place);
  }
  CarryMass(draft, sums, "mass.wheel_kg", mass.wheel_kg, kFirstWheel, kJoints);
  CarryMass(draft, sums, "mass.rocker_kg", mass.rocker_kg, kLeftRocker, kLeftBogie);
  CarryMass(draft, sums, "mass.bogie_kg", mass.bogie_kg, kLeftBogie, kFirstWheel);
  if (chassis.mass_kg > 0.0) {
    draft.CarryLength("mass.chassis_com_x_m", mass.chassis_com_x_m,
                      {{chassis.com_R.x(), chassis.place}});
    draft.CarryLength("mass.chassis_com_z_m", mass.chassis_com_z_m,
                      {{chassis.com_R.z(), chassis.place}});
  }
  NameMasses(draft, sums);
}

}  // namespace rockyard::rover
