// Chassis and panel of a rover from its URDF file (urdf_draft.h). rockyard's body is a box from the
// underside up to a panel of the overall length and width, both centred.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "rover/multibody/multibody.h"
#include "rover/rover_layout_params.h"
#include "rover/urdf_reader/urdf_draft.h"
#include "rover/urdf_reader/urdf_shapes.h"

namespace rockyard::rover {
namespace {

using Eigen::AlignedBox3d;
using math::Vector3;

// A box of the chassis, upright about the shape of the file.
struct BodyBox {
  const UrdfShape* shape = nullptr;
  AlignedBox3d extent_R;
};

// Returns the upright box about a box of the file.
BodyBox Upright(const UrdfPlacedShape& placed) {
  const Vector3 half = 0.5 * (placed.X_RS.linear().cwiseAbs() * placed.shape->sides_m);
  const Vector3 center = placed.X_RS.translation();
  return {placed.shape, AlignedBox3d(center - half, center + half)};
}

// Returns the boxes of the chassis, the largest first. What else stands on it is named.
std::vector<BodyBox> BoxesOf(UrdfDraft& draft) {
  std::vector<BodyBox> boxes;
  std::vector<const UrdfShape*> others;
  for (const UrdfPlacedShape& placed : PlacedShapes(draft.model, draft.skeleton)) {
    if (placed.body != kChassis) continue;
    if (placed.shape->kind == UrdfShapeKind::kBox) {
      boxes.push_back(Upright(placed));
    } else {
      others.push_back(placed.shape);
    }
  }
  std::stable_sort(boxes.begin(), boxes.end(), [](const BodyBox& a, const BodyBox& b) {
    return a.extent_R.volume() > b.extent_R.volume();
  });
  for (std::size_t i = 2; i < boxes.size(); ++i) others.push_back(boxes[i].shape);
  if (!others.empty()) {
    draft.findings.NotTaken(
        others.front()->place,
        fmt::format("is neither of the two largest boxes of the chassis, which make rockyard's{}",
                    others.size() == 1 ? std::string()
                                       : fmt::format(", nor are {} more", others.size() - 1)));
  }
  boxes.resize(std::min<std::size_t>(boxes.size(), 2));
  return boxes;
}

std::string Extent(const AlignedBox3d& box) {
  return fmt::format("({:.4f}, {:.4f}, {:.4f}) to ({:.4f}, {:.4f}, {:.4f}) m", box.min().x(),
                     box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z());
}

void NameBox(UrdfDraft& draft, const BodyBox& box, std::string_view what,
             const AlignedBox3d& rover_R) {
  const double off_m = std::max((box.extent_R.min() - rover_R.min()).cwiseAbs().maxCoeff(),
                                (box.extent_R.max() - rover_R.max()).cwiseAbs().maxCoeff());
  if (off_m <= kSameLength_m) return;
  draft.findings.NotTaken(box.shape->place,
                          fmt::format("reaches from {}: rockyard's {} reaches from {}",
                                      Extent(box.extent_R), what, Extent(rover_R)));
}

double LengthOverWheels(const RoverGeometryParams& geometry) {
  return geometry.wheelbase_m + 2.0 * geometry.wheel_radius_m;
}

// The overall length is that of the panel, which covers the wheels.
void CarryOverallLength(UrdfDraft& draft, double length_m, const std::string& place) {
  RoverGeometryParams& geometry = draft.params.geometry;
  const double wheels_m = LengthOverWheels(geometry);
  if (wheels_m > length_m + kSameLength_m) {
    draft.findings.NotTaken(place, fmt::format("ends before the wheels: rockyard's panel is as "
                                               "long as the rover with its wheels, {:.4f} m",
                                               wheels_m));
  }
  draft.CarryLength("geometry.length_m", geometry.length_m,
                    {{std::max(length_m, wheels_m), place}});
}

}  // namespace

void ReadUrdfBody(UrdfDraft& draft) {
  RoverGeometryParams& geometry = draft.params.geometry;
  const std::vector<BodyBox> boxes = BoxesOf(draft);
  if (boxes.empty()) {
    const std::string& place = draft.model.links[draft.skeleton.chassis].place;
    draft.findings.NotTaken(place,
                            "has no box from which a chassis could be read: of the body "
                            "rockyard knows that it is as long as the rover with its wheels");
    draft.CarryLength("geometry.length_m", geometry.length_m,
                      {{LengthOverWheels(geometry), place}});
    return;
  }
  // Of two boxes the chassis reaches lower and the panel higher.
  const BodyBox& belly =
      *std::min_element(boxes.begin(), boxes.end(), [](const BodyBox& a, const BodyBox& b) {
        return a.extent_R.min().z() < b.extent_R.min().z();
      });
  const BodyBox& panel =
      *std::max_element(boxes.begin(), boxes.end(), [](const BodyBox& a, const BodyBox& b) {
        return a.extent_R.max().z() < b.extent_R.max().z();
      });
  const auto carry = [&](std::string_view path, double& field, double value_m, const BodyBox& box) {
    draft.CarryLength(path, field, {{value_m, box.shape->place}});
  };
  carry("geometry.belly_clearance_m", geometry.belly_clearance_m, belly.extent_R.min().z(), belly);
  carry("geometry.belly_length_m", geometry.belly_length_m, belly.extent_R.sizes().x(), belly);
  carry("geometry.belly_width_m", geometry.belly_width_m, belly.extent_R.sizes().y(), belly);
  carry("geometry.height_m", geometry.height_m, panel.extent_R.max().z(), panel);
  CarryOverallLength(draft, panel.extent_R.sizes().x(), panel.shape->place);
  const auto rover = BodyBoxes(geometry);
  if (&belly == &panel) {
    draft.findings.NotTaken(
        panel.shape->place,
        fmt::format("is chassis and panel in one: rockyard's rover has a panel from {} on top",
                    Extent(rover[1])));
    return;
  }
  NameBox(draft, belly, "chassis", rover[0]);
  NameBox(draft, panel, "panel", rover[1]);
}

}  // namespace rockyard::rover
