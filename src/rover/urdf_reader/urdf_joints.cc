// Stops, motors and the differential of a rover from its URDF file (urdf_draft.h), and the joints
// that rockyard's rovers have not.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "math/angles.h"
#include "math/functions.h"
#include "rover/urdf_reader/urdf_draft.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

// From here on an axis that leans is named.
constexpr double kNamedLean_rad = math::DegToRad(0.1);

// Returns the stop on either side of zero that a joint tells, if it has stops; different ones are
// named.
std::vector<ToldValue> StopsOf(UrdfDraft& draft, const std::vector<std::size_t>& joints) {
  std::vector<ToldValue> told;
  for (const std::size_t index : joints) {
    const UrdfJoint& joint = draft.Joint(index);
    if (joint.kind != UrdfJointKind::kRevolute) continue;  // turns without end
    const double stop_rad = std::min(-joint.lower, joint.upper);
    if (std::abs(joint.lower + joint.upper) > kSameShare) {
      draft.findings.NotTaken(
          joint.place, fmt::format("stops at {:.4g} and {:.4g} rad: rockyard's stops are alike on "
                                   "either side, and this counts with {:.4g}",
                                   joint.lower, joint.upper, stop_rad));
    }
    told.push_back({stop_rad + 0.0, joint.place});
  }
  return told;
}

// Returns a limit of joints, times `factor`. 0 and less tell nothing, which is named.
std::vector<ToldValue> LimitsOf(UrdfDraft& draft, const std::vector<std::size_t>& joints,
                                std::optional<double> UrdfJoint::*limit, std::string_view name) {
  std::vector<ToldValue> told;
  for (const std::size_t index : joints) {
    const UrdfJoint& joint = draft.Joint(index);
    if (!(joint.*limit)) continue;
    if (*(joint.*limit) > 0.0) {
      told.push_back({*(joint.*limit), joint.place});
    } else {
      draft.findings.NotTaken(
          joint.place, fmt::format("has the {} {:g}, which tells no motor", name, *(joint.*limit)));
    }
  }
  return told;
}

void CarryLimit(UrdfDraft& draft, std::string_view path, double& field,
                const std::vector<ToldValue>& told) {
  draft.CarryAgreed(path, field, told, told.empty() ? 0.0 : kSameShare * told.front().value);
}

void ReadMotors(UrdfDraft& draft, const std::vector<std::size_t>& wheels,
                const std::vector<std::size_t>& steering) {
  RoverDriveParams& drive = draft.params.drive;
  CarryLimit(draft, "drive.stall_torque_Nm", drive.stall_torque_Nm,
             LimitsOf(draft, wheels, &UrdfJoint::effort, "effort"));
  std::vector<ToldValue> speeds = LimitsOf(draft, wheels, &UrdfJoint::velocity, "velocity");
  for (ToldValue& each : speeds) {
    each.value = TwelveDigits(each.value * draft.params.geometry.wheel_radius_m);
  }
  CarryLimit(draft, "drive.speed_m_s", drive.speed_m_s, speeds);
  CarryLimit(draft, "drive.steer_rate_deg_s", drive.steer_rate_rad_s,
             LimitsOf(draft, steering, &UrdfJoint::velocity, "velocity"));
  // rockyard's steering motors hold whatever comes, so that only another torque than that of the
  // wheels says something.
  for (const std::size_t index : steering) {
    const UrdfJoint& joint = draft.Joint(index);
    const double torque_Nm = joint.effort.value_or(0.0);
    const double drive_Nm = drive.stall_torque_Nm;
    if (torque_Nm <= 0.0 || std::abs(torque_Nm - drive_Nm) <= kSameShare * drive_Nm) continue;
    draft.findings.NotTaken(joint.place, fmt::format("has the effort {:g} Nm: rockyard's steering "
                                                     "motors turn whatever resists",
                                                     torque_Nm));
    break;
  }
}

// Returns the joint that a joint follows in the end, and how many times it turns as fast; itself
// where it follows none.
std::pair<std::size_t, double> MasterOf(const UrdfModel& model, std::size_t joint) {
  double ratio = 1.0;
  // A chain that is longer than there are joints is a circle.
  for (std::size_t i = 0; i <= model.joints.size() && model.joints[joint].mimic; ++i) {
    ratio *= model.joints[joint].mimic->multiplier;
    joint = model.joints[joint].mimic->joint;
  }
  return {joint, ratio};
}

// Names a differential other than rockyard's, in which the rockers turn against each other by equal
// angles.
void NameDifferential(UrdfDraft& draft) {
  const auto& rocker = draft.skeleton.rocker;
  if (!rocker[0] || !rocker[1]) return;
  const auto [left, left_ratio] = MasterOf(draft.model, *rocker[0]);
  const auto [right, right_ratio] = MasterOf(draft.model, *rocker[1]);
  const std::string& place = draft.Joint(*rocker[1]).place;
  if (left != right) {
    draft.findings.NotTaken(place,
                            "follows the left rocker by no <mimic>: rockyard's rover has a "
                            "differential between them");
    return;
  }
  // Rates about +y, whichever way the axes point.
  const auto about_y = [&](std::size_t joint) {
    return draft.skeleton.axis_R(draft.model, joint).y() > 0.0 ? 1.0 : -1.0;
  };
  const double right_rate = right_ratio * about_y(*rocker[1]);
  const double left_rate = left_ratio * about_y(*rocker[0]);
  if (std::abs(right_rate + left_rate) <= kSameShare * std::abs(left_rate)) return;
  draft.findings.NotTaken(place,
                          fmt::format("turns {:.4g} times as fast about y as the left rocker: "
                                      "rockyard's differential turns it -1 times as fast",
                                      right_rate / left_rate));
}

// Names joints that rockyard's rovers have not, and what of the others they have not.
void NameJoints(UrdfDraft& draft, const std::set<std::size_t>& known) {
  const auto& rocker = draft.skeleton.rocker;
  for (std::size_t i = 0; i < draft.model.joints.size(); ++i) {
    const UrdfJoint& joint = draft.Joint(i);
    if (joint.kind == UrdfJointKind::kFixed) continue;
    if (!known.contains(i)) {
      draft.findings.NotTaken(joint.place,
                              "does not move in rockyard: what it carries stays where "
                              "it is at zero");
      continue;
    }
    const Vector3 axis = draft.skeleton.axis_R(draft.model, i);
    const double along = std::max(std::abs(axis.y()), std::abs(axis.z()));
    const double lean_rad = math::Acos(std::min(along, 1.0));
    if (lean_rad > kNamedLean_rad) {
      draft.findings.NotTaken(joint.place,
                              fmt::format("has an axis that leans by {:.2g} deg: rockyard's are "
                                          "level or upright",
                                          math::RadToDeg(lean_rad)));
    }
    if (!joint.mimic) continue;
    const bool differential = i == rocker[0] || i == rocker[1];
    if (!differential || joint.mimic->offset != 0.0) {
      draft.findings.NotTaken(joint.place, differential ? "follows another joint with an offset"
                                                        : "follows another joint: rockyard's do "
                                                          "not, but for the rockers");
    }
  }
}

}  // namespace

void ReadUrdfJoints(UrdfDraft& draft) {
  std::vector<std::size_t> wheels;
  std::vector<std::size_t> steering;
  for (const UrdfWheel& wheel : draft.skeleton.wheels) {
    wheels.push_back(wheel.joint);
    if (wheel.steering) steering.push_back(*wheel.steering);
  }
  const std::vector<std::size_t> bogies(draft.skeleton.bogie.begin(), draft.skeleton.bogie.end());
  std::vector<std::size_t> rockers;
  for (const auto& rocker : draft.skeleton.rocker) {
    if (rocker) rockers.push_back(*rocker);
  }
  RoverGeometryParams& geometry = draft.params.geometry;
  const auto carry_stop = [&](std::string_view path, double& field,
                              const std::vector<std::size_t>& joints) {
    draft.CarryAgreed(path, field, StopsOf(draft, joints), kSameShare);
  };
  carry_stop("geometry.rocker_limit_deg", geometry.rocker_limit_rad, rockers);
  carry_stop("geometry.bogie_limit_deg", geometry.bogie_limit_rad, bogies);
  carry_stop("drive.max_steer_deg", draft.params.drive.max_steer_rad, steering);
  ReadMotors(draft, wheels, steering);
  NameDifferential(draft);
  std::set<std::size_t> known(wheels.begin(), wheels.end());
  for (const std::vector<std::size_t>& joints : {steering, bogies, rockers}) {
    known.insert(joints.begin(), joints.end());
  }
  NameJoints(draft, known);
}

}  // namespace rockyard::rover
