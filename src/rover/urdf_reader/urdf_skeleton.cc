#include "rover/urdf_reader/urdf_skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "rover/multibody/multibody.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using messages::kWheelCount;

constexpr std::size_t kAxlesASide = 3;

class SkeletonFinder {
 public:
  SkeletonFinder(const UrdfModel& model, UrdfFindings& findings)
      : model_(model), findings_(findings), bodies_(model) {}

  UrdfSkeleton Find() {
    found_.X_0L = bodies_.X_0L();
    FindWheels();
    findings_.ThrowIfFailed();
    for (std::size_t i = 0; i < kWheelCount; ++i) FindArm(i);
    findings_.ThrowIfFailed();
    for (std::size_t side = 0; side < 2; ++side) FindBogie(side);
    findings_.ThrowIfFailed();
    FindRockers();
    FindSteered();
    findings_.ThrowIfFailed();
    PlaceRover();
    AssignLinks();
    return std::move(found_);
  }

 private:
  const UrdfJoint& Joint(std::size_t joint) const { return model_.joints[joint]; }

  // Fails with the joint that carries a body, or its first link.
  void FailAt(std::size_t body, const std::string& reason, const std::string& suggestion) {
    const auto carrier = bodies_.Carrier(body);
    findings_.Fail(carrier ? Joint(*carrier).place : model_.links[body].place, reason, suggestion);
  }

  void FindWheels() {
    std::vector<UrdfWheel> wheels;
    std::vector<std::size_t> bare;  // what could be wheels but for their shape
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      const bool rolls = Joint(i).kind == UrdfJointKind::kContinuous &&
                         bodies_.TurnsAbout(i, Vector3::UnitY()) &&
                         bodies_.Carries(bodies_.Below(i)) == 0;
      if (!rolls) continue;
      if (const auto rim = bodies_.RimOf(i)) {
        wheels.push_back({.joint = i, .rim = *rim});
      } else {
        bare.push_back(i);
      }
    }
    if (wheels.size() == kWheelCount) return SortWheels(std::move(wheels));
    findings_.Fail("",
                   fmt::format("has {} wheels, where rockyard's rovers have {}: continuous joints "
                               "about y (x ahead, y left, z up at the root) whose links have a "
                               "cylinder about that axis and carry no movable joint",
                               wheels.size(), kWheelCount),
                   "describe a rocker-bogie of six wheels");
    for (const std::size_t joint : bare) {
      findings_.Fail(Joint(joint).place, "turns like a wheel, but has no cylinder about its axis",
                     "give its link a <collision> with a <cylinder> of the wheel's size");
    }
  }

  // Left before right, from the front to the rear, as messages::Wheel.
  void SortWheels(std::vector<UrdfWheel> wheels) {
    double middle_m = 0.0;
    for (const UrdfWheel& wheel : wheels) middle_m += wheel.rim.center_0.y() / kWheelCount;
    const auto key = [&](const UrdfWheel& wheel) {
      return std::pair(wheel.rim.center_0.y() <= middle_m, -wheel.rim.center_0.x());
    };
    std::stable_sort(wheels.begin(), wheels.end(),
                     [&](const UrdfWheel& a, const UrdfWheel& b) { return key(a) < key(b); });
    const auto left = std::count_if(wheels.begin(), wheels.end(),
                                    [&](const UrdfWheel& wheel) { return !key(wheel).first; });
    if (left != kAxlesASide) {
      findings_.Fail("",
                     fmt::format("has {} wheels on the left and {} on the right", left,
                                 static_cast<std::ptrdiff_t>(kWheelCount) - left),
                     "put three on either side");
    }
    std::copy(wheels.begin(), wheels.end(), found_.wheels.begin());
  }

  // Finds the body on which a wheel hangs, past what steers it.
  void FindArm(std::size_t wheel) {
    UrdfWheel& found = found_.wheels[wheel];
    std::size_t arm = bodies_.Above(found.joint);
    const auto carrier = bodies_.Carrier(arm);
    if (carrier && bodies_.TurnsAbout(*carrier, Vector3::UnitZ())) {
      found.steering = carrier;
      if (bodies_.Carries(arm) != 1) {
        findings_.Fail(Joint(*carrier).place, "steers more than one wheel, or carries more",
                       "let each steering joint carry one wheel alone");
      }
      arm = bodies_.Above(*carrier);
    }
    arms_[wheel] = arm;
  }

  void FindBogie(std::size_t side) {
    const std::size_t front = kAxlesASide * side;
    const std::size_t middle = front + 1;
    const std::size_t rear = front + 2;
    const bool with_front = arms_[front] == arms_[middle];
    if (with_front == (arms_[middle] == arms_[rear])) {
      findings_.Fail(Joint(found_.wheels[middle].joint).place,
                     with_front ? "hangs on one link with the wheels before and behind it"
                                : "shares its link with neither the wheel before nor the one "
                                  "behind it",
                     "let the middle wheel and one other hang on a bogie that turns about y");
      return;
    }
    const BogieEnd end = with_front ? BogieEnd::kFront : BogieEnd::kRear;
    if (side == 1 && end != found_.bogie_end) {
      FailAt(arms_[middle], "has its bogie at another end than the left side",
             "put both bogies in front or both at the rear");
    }
    found_.bogie_end = end;
    rockers_[side] = arms_[with_front ? rear : front];
    const std::size_t bogie = arms_[middle];
    const auto carrier = bodies_.Carrier(bogie);
    if (!carrier || !bodies_.TurnsAbout(*carrier, Vector3::UnitY())) {
      FailAt(bogie, "carries two wheels and does not turn about y", "let it turn as a bogie does");
      return;
    }
    if (bodies_.Above(*carrier) != rockers_[side]) {
      FailAt(bogie, "is a bogie that does not hang on the link of the third wheel",
             "let the rocker carry the third wheel and the bogie");
    }
    found_.bogie[side] = *carrier;
  }

  // Returns the body above that of a rocker.
  std::optional<std::size_t> AboveRocker(std::size_t side) const {
    const auto carrier = bodies_.Carrier(rockers_[side]);
    if (!carrier) return std::nullopt;
    return bodies_.Above(*carrier);
  }

  // A side whose rocker is fixed to the chassis has its third wheel and its bogie on the chassis.
  void FindRockers() {
    const auto left = AboveRocker(0);
    const auto right = AboveRocker(1);
    if (rockers_[0] == rockers_[1]) {
      found_.chassis = rockers_[0];
      return;
    }
    if (right == rockers_[0] || left == rockers_[1]) {
      const std::size_t turning = right == rockers_[0] ? 1 : 0;
      found_.chassis = rockers_[1 - turning];
      TakeRocker(turning);
      return;
    }
    if (!left || !right || left != right) {
      FailAt(rockers_[1], "is a rocker on another link than the left one",
             "let the chassis carry both rockers");
      return;
    }
    found_.chassis = *left;
    TakeRocker(0);
    TakeRocker(1);
  }

  void TakeRocker(std::size_t side) {
    const std::size_t carrier = bodies_.Carrier(rockers_[side]).value_or(0);
    if (!bodies_.TurnsAbout(carrier, Vector3::UnitY())) {
      FailAt(rockers_[side], "carries a rocker and does not turn about y",
             "let rockers turn about y");
    }
    found_.rocker[side] = carrier;
  }

  void FindSteered() {
    std::string steered;
    for (const UrdfWheel& wheel : found_.wheels) steered += wheel.steering ? 's' : '-';
    if (steered == "ssssss") {
      found_.steered = SteeredWheels::kAll;
    } else if (steered != "s-ss-s") {
      findings_.Fail("",
                     fmt::format("steers {} wheels in a way that rockyard's rovers do not",
                                 std::count(steered.begin(), steered.end(), 's')),
                     "steer the four outer wheels or all six, each by a joint about z");
    }
  }

  void PlaceRover() {
    Vector3& p_0R = found_.p_0R;
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const UrdfRim& rim = found_.wheels[i].rim;
      if (i % kAxlesASide != 1) p_0R.x() += rim.center_0.x() / 4.0;
      p_0R.y() += rim.center_0.y() / kWheelCount;
      p_0R.z() += (rim.center_0.z() - rim.shape->radius_m) / kWheelCount;
    }
  }

  void AssignLinks() {
    found_.body.assign(model_.links.size(), kChassis);
    std::vector<std::optional<int>> own(model_.links.size());
    own[found_.chassis] = kChassis;
    for (std::size_t side = 0; side < 2; ++side) {
      const int offset = static_cast<int>(side);
      if (found_.rocker[side]) own[rockers_[side]] = kLeftRocker + offset;
      own[bodies_.Below(found_.bogie[side])] = kLeftBogie + offset;
    }
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const UrdfWheel& wheel = found_.wheels[i];
      const int body = kFirstWheel + static_cast<int>(i);
      own[bodies_.Below(wheel.joint)] = body;
      if (wheel.steering) own[bodies_.Below(*wheel.steering)] = body;
    }
    for (const std::size_t link : model_.order) {
      const auto carrier = model_.links[link].parent_joint;
      found_.body[link] =
          own[link].value_or(carrier ? found_.body[model_.joints[*carrier].parent] : kChassis);
    }
  }

  const UrdfModel& model_;
  UrdfFindings& findings_;
  const UrdfBodies bodies_;
  UrdfSkeleton found_;
  messages::PerWheel<std::size_t> arms_{};  // bodies
  std::array<std::size_t, 2> rockers_{};    // bodies that carry the third wheel, by Side
};

}  // namespace

UrdfSkeleton FindSkeleton(const UrdfModel& model, UrdfFindings& findings) {
  return SkeletonFinder(model, findings).Find();
}

}  // namespace rockyard::rover
