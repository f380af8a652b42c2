// Arms, knees and hubs of a rover from its URDF file (urdf_draft.h). rockyard's arms are bars from
// pivot to pivot and from pivots to knees, with a strut from each knee down to a hub beside its
// wheel.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "rover/multibody/multibody.h"
#include "rover/urdf_reader/urdf_draft.h"
#include "rover/urdf_reader/urdf_shapes.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using messages::kWheelCount;

// A cylinder this many times longer than its radius is a bar, not the housing of a motor.
constexpr double kSlender = 4.0;
// How far from its wheel's axle, seen from the side, a strut or hub may stand, in wheel radii.
constexpr double kBesideWheel = 0.25;
// How far above or below the middle of its wheel a strut may end, in wheel radii.
constexpr double kStrutOff = 2.0;

// A strut of a wheel: the end by the wheel, and the knee.
struct UrdfStrut {
  const UrdfShape* shape = nullptr;
  double hub_z_m = 0.0;
  double knee_z_m = 0.0;
};

class ArmReader {
 public:
  explicit ArmReader(UrdfDraft& draft)
      : draft_(draft), shapes_(PlacedShapes(draft.model, draft.skeleton)) {}

  void Read() {
    ReadBars();
    std::vector<ToldValue> knees_m;
    std::vector<ToldValue> hubs_m;
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const auto strut = StrutOf(i);
      if (strut) knees_m.push_back({strut->knee_z_m, strut->shape->place});
      if (const auto hub = HubOf(i, strut)) hubs_m.push_back(*hub);
    }
    RoverGeometryParams& geometry = draft_.params.geometry;
    draft_.CarryLength("geometry.knee_z_m", geometry.knee_z_m, knees_m);
    draft_.CarryLength("geometry.hub_radius_m", geometry.hub_radius_m, hubs_m);
    NameOthers();
  }

 private:
  static bool IsArm(int body) { return body >= kLeftRocker && body <= kRightBogie; }

  // The bodies on which a wheel hangs: the arm, and the wheel's own with what steers it.
  bool Hangs(const UrdfPlacedShape& placed, std::size_t wheel) const {
    const UrdfWheel& found = draft_.skeleton.wheels[wheel];
    const std::size_t link = draft_.Joint(found.steering.value_or(found.joint)).parent;
    const bool rim = placed.shape == found.rim.shape;
    return !rim && (placed.body == draft_.skeleton.body[link] ||
                    placed.body == kFirstWheel + static_cast<int>(wheel));
  }

  void ReadBars() {
    std::vector<ToldValue> bars_m;
    std::vector<ToldValue> short_bars_m;
    for (const UrdfPlacedShape& placed : shapes_) {
      const UrdfShape& shape = *placed.shape;
      const bool bar = IsArm(placed.body) && shape.kind == UrdfShapeKind::kCylinder &&
                       !AreAlong(placed.X_RS.linear().col(2), Vector3::UnitY());
      if (!bar) continue;
      const bool slender = shape.length_m > kSlender * shape.radius_m;
      (slender ? bars_m : short_bars_m).push_back({shape.radius_m, shape.place});
      used_.insert(&shape);
    }
    draft_.CarryLength("geometry.arm_radius_m", draft_.params.geometry.arm_radius_m,
                       bars_m.empty() ? short_bars_m : bars_m);
  }

  // Returns how far a place is from a wheel's axle along x, in wheel radii.
  double BesideWheel(const Vector3& p_R, std::size_t wheel) const {
    return std::abs(p_R.x() - draft_.p_RWheel(wheel).x()) /
           draft_.skeleton.wheels[wheel].rim.shape->radius_m;
  }

  // Returns the upright cylinder that ends nearest to the middle of a wheel, and of several the
  // longest.
  std::optional<UrdfStrut> StrutOf(std::size_t wheel) {
    const double wheel_z_m = draft_.p_RWheel(wheel).z();
    const double radius_m = draft_.skeleton.wheels[wheel].rim.shape->radius_m;
    std::optional<UrdfStrut> best;
    for (const UrdfPlacedShape& placed : shapes_) {
      const UrdfShape& shape = *placed.shape;
      if (shape.kind != UrdfShapeKind::kCylinder || !Hangs(placed, wheel)) continue;
      const Vector3 center = placed.X_RS.translation();
      if (!AreAlong(placed.X_RS.linear().col(2), Vector3::UnitZ()) ||
          !(BesideWheel(center, wheel) <= kBesideWheel)) {
        continue;
      }
      const double up_m = center.z() + 0.5 * shape.length_m;
      const double down_m = center.z() - 0.5 * shape.length_m;
      const bool from_below = std::abs(down_m - wheel_z_m) <= std::abs(up_m - wheel_z_m);
      const UrdfStrut strut{&shape, from_below ? down_m : up_m, from_below ? up_m : down_m};
      const double off_m = std::abs(strut.hub_z_m - wheel_z_m);
      if (off_m > kStrutOff * radius_m) continue;
      const double best_off_m = best ? std::abs(best->hub_z_m - wheel_z_m) : 0.0;
      const bool as_near = best && IsSame(off_m, best_off_m);
      if (!best || (as_near ? shape.length_m > best->shape->length_m : off_m < best_off_m)) {
        best = strut;
      }
    }
    if (best) used_.insert(best->shape);
    return best;
  }

  // Returns the largest ball at the height of a wheel's axle. One is no hub: the end of the strut.
  std::optional<ToldValue> HubOf(std::size_t wheel, const std::optional<UrdfStrut>& strut) {
    const double wheel_z_m = draft_.p_RWheel(wheel).z();
    const double reach_m = kBesideWheel * draft_.skeleton.wheels[wheel].rim.shape->radius_m;
    std::vector<const UrdfShape*> balls;
    for (const UrdfPlacedShape& placed : shapes_) {
      const Vector3 center = placed.X_RS.translation();
      const bool ball = placed.shape->kind == UrdfShapeKind::kSphere && Hangs(placed, wheel) &&
                        BesideWheel(center, wheel) <= kBesideWheel &&
                        std::abs(center.z() - wheel_z_m) <= reach_m;
      if (ball) balls.push_back(placed.shape);
    }
    used_.insert(balls.begin(), balls.end());
    if (strut) {
      const auto end = std::find_if(balls.begin(), balls.end(), [&](const UrdfShape* ball) {
        return IsSame(ball->radius_m, strut->shape->radius_m);
      });
      if (end != balls.end()) balls.erase(end);
    }
    if (balls.empty()) return std::nullopt;
    const UrdfShape* const hub = *std::max_element(
        balls.begin(), balls.end(),
        [](const UrdfShape* a, const UrdfShape* b) { return a->radius_m < b->radius_m; });
    return ToldValue{hub->radius_m, hub->place};
  }

  static bool IsSame(double a_m, double b_m) { return std::abs(a_m - b_m) <= kSameLength_m; }

  // Names what else stands on arms and wheels, once for each of them. Balls as thick as the arms
  // round their ends.
  void NameOthers() {
    for (const UrdfWheel& wheel : draft_.skeleton.wheels) used_.insert(wheel.rim.shape);
    const double arm_m = draft_.params.geometry.arm_radius_m;
    std::array<std::vector<const UrdfShape*>, kJoints> others;
    for (const UrdfPlacedShape& placed : shapes_) {
      const UrdfShape& shape = *placed.shape;
      const bool end = IsArm(placed.body) && shape.kind == UrdfShapeKind::kSphere &&
                       IsSame(shape.radius_m, arm_m);
      if (placed.body == kChassis || end || used_.contains(&shape)) continue;
      others[static_cast<std::size_t>(placed.body)].push_back(&shape);
    }
    for (const auto& shapes : others) {
      if (shapes.empty()) continue;
      draft_.findings.NotTaken(
          shapes.front()->place,
          fmt::format("is no bar, strut, hub or rim of rockyard's rover{}",
                      shapes.size() == 1 ? std::string()
                                         : fmt::format(", nor are {} more", shapes.size() - 1)));
    }
  }

  UrdfDraft& draft_;
  const std::vector<UrdfPlacedShape> shapes_;
  std::set<const UrdfShape*> used_;
};

}  // namespace

void ReadUrdfArms(UrdfDraft& draft) { ArmReader(draft).Read(); }

}  // namespace rockyard::rover
