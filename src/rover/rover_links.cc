#include "rover/rover_links.h"

#include <array>
#include <string_view>

#include "rover/multibody/multibody.h"
#include "rover/rover_layout_params.h"

namespace rockyard::rover {
namespace {

constexpr std::array<std::string_view, 2> kSideNames{"left", "right"};
constexpr std::array<std::string_view, 3> kAxles{"front", "middle", "rear"};

// Builds the list of links.
class LinkTree {
 public:
  explicit LinkTree(const RoverGeometryParams& params) : geometry_(MakeRoverGeometry(params)) {
    links_.push_back({.name = "chassis", .body = kChassis});
  }

  std::vector<Link> Build() {
    for (std::size_t side = 0; side < 2; ++side) AddSide(side);
    return std::move(links_);
  }

 private:
  // Returns the index of the link, which becomes the parent of what it carries.
  int Add(Link link) {
    links_.push_back(std::move(link));
    return static_cast<int>(links_.size()) - 1;
  }

  void AddSide(std::size_t side) {
    const std::string name(kSideNames[side]);
    const math::Vector3& rocker_R = geometry_.rocker_pivot_R[side];
    const math::Vector3& bogie_R = geometry_.bogie_pivot_R[side];
    const int offset = static_cast<int>(side);
    const int rocker = Add({.name = name + "_rocker",
                            .joint = LinkJoint::kRocker,
                            .index = side,
                            .parent = 0,
                            .body = kLeftRocker + offset,
                            .pivot_P = rocker_R});
    // Frames are parallel at zero angles, so differences of positions in R are vectors of the
    // parent.
    const int bogie = Add({.name = name + "_bogie",
                           .joint = LinkJoint::kBogie,
                           .index = side,
                           .parent = rocker,
                           .body = kLeftBogie + offset,
                           .pivot_P = bogie_R - rocker_R});
    for (std::size_t axle = 0; axle < kAxles.size(); ++axle) {
      const std::size_t wheel = kAxles.size() * side + axle;
      const bool on_bogie = geometry_.on_bogie[wheel];
      AddWheel(wheel, name + "_" + std::string(kAxles[axle]), on_bogie ? bogie : rocker,
               geometry_.wheel_R[wheel] - (on_bogie ? bogie_R : rocker_R));
    }
  }

  void AddWheel(std::size_t wheel, const std::string& name, int arm, const math::Vector3& p_arm) {
    Link link{.name = name + "_wheel",
              .joint = LinkJoint::kWheel,
              .index = wheel,
              .parent = arm,
              .body = kFirstWheel + static_cast<int>(wheel),
              .pivot_P = p_arm};
    // A steered wheel hangs on a knuckle that turns about the vertical through the wheel's centre,
    // so the wheel's own pivot is at the knuckle's origin.
    if (geometry_.steered[wheel]) {
      link.parent = Add({.name = name + "_knuckle",
                         .joint = LinkJoint::kSteering,
                         .index = wheel,
                         .parent = arm,
                         .pivot_P = p_arm,
                         .axis = math::Vector3::UnitZ()});
      link.pivot_P.setZero();
    }
    Add(std::move(link));
  }

  const RoverGeometry geometry_;
  std::vector<Link> links_;
};

}  // namespace

std::vector<Link> MakeLinks(const RoverGeometryParams& params) { return LinkTree(params).Build(); }

double JointAngle(const Link& link, const truth::RoverPosture& posture) {
  const bool left = link.index == 0;
  switch (link.joint) {
    case LinkJoint::kFixed:
      return 0.0;
    case LinkJoint::kRocker:
      return left ? posture.left_rocker_rad : posture.right_rocker_rad;
    case LinkJoint::kBogie:
      return left ? posture.left_bogie_rad : posture.right_bogie_rad;
    case LinkJoint::kSteering:
      return posture.steer_rad.at(link.index);
    case LinkJoint::kWheel:
      return posture.wheel_angle_rad.at(link.index);
  }
  return 0.0;
}

}  // namespace rockyard::rover
