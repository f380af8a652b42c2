#include "rover/urdf_reader/urdf_shapes.h"

#include <array>

#include "rover/multibody/multibody.h"

namespace rockyard::rover {

std::vector<UrdfPlacedShape> PlacedShapes(const UrdfModel& model, const UrdfSkeleton& skeleton) {
  std::vector<UrdfPlacedShape> all;
  std::array<bool, kJoints + 1> collides{};  // the chassis first
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    const int body = skeleton.body[link];
    for (const UrdfShape& shape : model.links[link].shapes) {
      math::Transform X_RS = skeleton.X_0L[link] * shape.X_LS;
      X_RS.translation() -= skeleton.p_0R;
      all.push_back({&shape, body, X_RS});
      if (shape.use == UrdfUse::kCollision)
        collides[static_cast<std::size_t>(body - kChassis)] = true;
    }
  }
  std::erase_if(all, [&](const UrdfPlacedShape& each) {
    return each.shape->use == UrdfUse::kVisual &&
           collides[static_cast<std::size_t>(each.body - kChassis)];
  });
  return all;
}

}  // namespace rockyard::rover
