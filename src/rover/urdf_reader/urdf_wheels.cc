// Wheels and pivots of a rover from its URDF file (urdf_draft.h).
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "rover/rover_layout_params.h"
#include "rover/urdf_reader/urdf_draft.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using messages::kWheelCount;

// Of values whose differences are named by the places of wheels and pivots.
constexpr double kNamedElsewhere = std::numeric_limits<double>::infinity();

void ReadRims(UrdfDraft& draft) {
  std::vector<ToldValue> radii_m;
  std::vector<ToldValue> widths_m;
  std::vector<ToldValue> overall_m;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const UrdfShape& rim = *draft.skeleton.wheels[i].rim.shape;
    radii_m.push_back({rim.radius_m, rim.place});
    widths_m.push_back({rim.length_m, rim.place});
    overall_m.push_back({2.0 * std::abs(draft.p_RWheel(i).y()) + rim.length_m, rim.place});
  }
  RoverGeometryParams& geometry = draft.params.geometry;
  draft.CarryLength("geometry.wheel_radius_m", geometry.wheel_radius_m, radii_m);
  draft.CarryLength("geometry.wheel_width_m", geometry.wheel_width_m, widths_m);
  draft.CarryLength("geometry.width_m", geometry.width_m, overall_m, kNamedElsewhere);
}

void ReadAxles(UrdfDraft& draft) {
  std::vector<ToldValue> wheelbases_m;
  std::vector<ToldValue> middles_m;
  const double mirror = draft.skeleton.bogie_end == BogieEnd::kFront ? -1.0 : 1.0;
  for (const std::size_t front : {0, 3}) {
    const auto place = [&](std::size_t wheel) {
      return draft.Joint(draft.skeleton.wheels[wheel].joint).place;
    };
    wheelbases_m.push_back(
        {draft.p_RWheel(front).x() - draft.p_RWheel(front + 2).x(), place(front)});
    middles_m.push_back({mirror * draft.p_RWheel(front + 1).x(), place(front + 1)});
  }
  RoverGeometryParams& geometry = draft.params.geometry;
  draft.CarryLength("geometry.wheelbase_m", geometry.wheelbase_m, wheelbases_m, kNamedElsewhere);
  draft.CarryLength("geometry.middle_wheel_x_m", geometry.middle_wheel_x_m, middles_m,
                    kNamedElsewhere);
}

// A pivot's place along its axis says nothing; that of the bogies is taken for the arms.
void ReadPivots(UrdfDraft& draft) {
  const UrdfSkeleton& skeleton = draft.skeleton;
  const double mirror = skeleton.bogie_end == BogieEnd::kFront ? -1.0 : 1.0;
  std::vector<ToldValue> rocker_x_m;
  std::vector<ToldValue> rocker_z_m;
  std::vector<ToldValue> bogie_z_m;
  std::vector<ToldValue> arm_y_m;
  for (std::size_t side = 0; side < 2; ++side) {
    if (const auto rocker = skeleton.rocker[side]) {
      const Vector3 p = skeleton.p_RJ(draft.model, *rocker);
      rocker_x_m.push_back({mirror * p.x(), draft.Joint(*rocker).place});
      rocker_z_m.push_back({p.z(), draft.Joint(*rocker).place});
    } else {
      draft.findings.NotTaken(
          draft.Joint(skeleton.bogie[side]).place,
          fmt::format("hangs on the chassis: rockyard's rovers have a rocker pivot on either side, "
                      "which on the {} is {}",
                      side == 0 ? "left" : "right",
                      skeleton.rocker[1 - side] ? "that of the other side" : "not told here"));
    }
    const Vector3 p = skeleton.p_RJ(draft.model, skeleton.bogie[side]);
    bogie_z_m.push_back({p.z(), draft.Joint(skeleton.bogie[side]).place});
    arm_y_m.push_back({std::abs(p.y()), draft.Joint(skeleton.bogie[side]).place});
  }
  RoverGeometryParams& geometry = draft.params.geometry;
  draft.CarryLength("geometry.rocker_pivot_x_m", geometry.rocker_pivot_x_m, rocker_x_m,
                    kNamedElsewhere);
  draft.CarryLength("geometry.rocker_pivot_z_m", geometry.rocker_pivot_z_m, rocker_z_m,
                    kNamedElsewhere);
  draft.CarryLength("geometry.bogie_pivot_z_m", geometry.bogie_pivot_z_m, bogie_z_m,
                    kNamedElsewhere);
  draft.CarryLength("geometry.arm_y_m", geometry.arm_y_m, arm_y_m);
}

// Names a joint whose place in the file is not that in rockyard's rover.
void NamePlace(UrdfDraft& draft, std::size_t joint, std::string_view what, const Vector3& file_R,
               const Vector3& rover_R) {
  if ((file_R - rover_R).norm() <= kSameLength_m) return;
  draft.findings.NotTaken(
      draft.Joint(joint).place,
      fmt::format("has {} at ({:.4f}, {:.4f}, {:.4f}) m, from the ground below the middle of the "
                  "rover: in rockyard's, which is alike on both sides, at ({:.4f}, {:.4f}, {:.4f})",
                  what, file_R.x(), file_R.y(), file_R.z(), rover_R.x(), rover_R.y(), rover_R.z()));
}

void NamePlaces(UrdfDraft& draft) {
  const UrdfSkeleton& skeleton = draft.skeleton;
  const RoverGeometry geometry = MakeRoverGeometry(draft.params.geometry);
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const UrdfWheel& wheel = skeleton.wheels[i];
    NamePlace(draft, wheel.joint, "its wheel", draft.p_RWheel(i), geometry.wheel_R[i]);
    if (!wheel.steering) continue;
    // The axis through the joint, at the height of the wheel's centre.
    const Vector3 axis = skeleton.axis_R(draft.model, *wheel.steering);
    const Vector3 p = skeleton.p_RJ(draft.model, *wheel.steering);
    const Vector3 at = p + (draft.p_RWheel(i).z() - p.z()) / axis.z() * axis;
    const double off_m = (at - draft.p_RWheel(i)).norm();
    if (off_m <= kSameLength_m) continue;
    draft.findings.NotTaken(draft.Joint(*wheel.steering).place,
                            fmt::format("steers about a line {:.4f} m beside the middle of its "
                                        "wheel: rockyard's goes through it",
                                        off_m));
  }
  const auto name_pivot = [&](std::size_t joint, const Vector3& rover_R) {
    Vector3 file_R = skeleton.p_RJ(draft.model, joint);
    file_R.y() = rover_R.y();
    NamePlace(draft, joint, "its pivot", file_R, rover_R);
  };
  for (std::size_t side = 0; side < 2; ++side) {
    if (skeleton.rocker[side]) {
      name_pivot(*skeleton.rocker[side], geometry.rocker_pivot_R[side]);
    }
    name_pivot(skeleton.bogie[side], geometry.bogie_pivot_R[side]);
  }
}

}  // namespace

void ReadUrdfWheels(UrdfDraft& draft) {
  ReadRims(draft);
  ReadAxles(draft);
  ReadPivots(draft);
  RoverGeometryParams& geometry = draft.params.geometry;
  const std::string& bogie = draft.Joint(draft.skeleton.bogie[0]).place;
  draft.Carry("geometry.bogie_end", geometry.bogie_end, draft.skeleton.bogie_end, bogie);
  const auto& steering = draft.skeleton.wheels[0].steering;
  draft.Carry("geometry.steered_wheels", geometry.steered_wheels, draft.skeleton.steered,
              draft.Joint(steering.value_or(0)).place);
  NamePlaces(draft);
}

}  // namespace rockyard::rover
