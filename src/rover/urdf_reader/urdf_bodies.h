// The links of a robot as rigid bodies: links that fixed joints join are one. The search for the
// rocker-bogie (urdf_skeleton.h) walks along them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "math/pose.h"
#include "rover/urdf_reader/urdf_model.h"

namespace rockyard::rover {

// The cylinder of a wheel, and where its centre is in the frame of the root.
struct UrdfRim {
  const UrdfShape* shape = nullptr;  // in the model
  math::Vector3 center_0 = math::Vector3::Zero();
};

// Returns whether two unit vectors lie along one line, in either direction, within 5 deg.
bool AreAlong(const math::Vector3& a, const math::Vector3& b);

class UrdfBodies {
 public:
  // `model` must outlive this.
  explicit UrdfBodies(const UrdfModel& model);

  const std::vector<math::Transform>& X_0L() const { return X_0L_; }
  // Returns the link with which the body of a link begins: what names the body.
  std::size_t BodyOf(std::size_t link) const { return body_[link]; }
  // Returns the bodies on either side of a joint.
  std::size_t Above(std::size_t joint) const { return body_[model_.joints[joint].parent]; }
  std::size_t Below(std::size_t joint) const { return body_[model_.joints[joint].child]; }
  // Returns the movable joint that carries a body; none: it is the first.
  std::optional<std::size_t> Carrier(std::size_t body) const {
    return model_.links[body].parent_joint;
  }
  // Returns how many movable joints a body carries.
  std::size_t Carries(std::size_t body) const { return carries_[body]; }
  // Returns the axis of a joint in the frame of the root.
  math::Vector3 Axis_0(std::size_t joint) const;
  // Returns whether the joint turns about y, or z, of the root.
  bool TurnsAbout(std::size_t joint, const math::Vector3& axis_0) const;
  // Returns the largest cylinder of the joint's body about the joint's axis; among equal ones the
  // longest, and those of collisions before others.
  std::optional<UrdfRim> RimOf(std::size_t joint) const;

 private:
  // The link that holds the shape, with the shape.
  struct Placed {
    std::size_t link;
    const UrdfShape* shape;
  };

  bool IsAbout(const Placed& placed, std::size_t joint) const;

  const UrdfModel& model_;
  const std::vector<math::Transform> X_0L_;
  std::vector<std::size_t> body_;               // by link
  std::vector<std::size_t> carries_;            // by link with which a body begins
  std::vector<std::vector<Placed>> cylinders_;  // the same
};

}  // namespace rockyard::rover
