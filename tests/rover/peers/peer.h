// The rover in another physics engine, for peers_benchmark.cc: masses, joints, motors and shapes
// are those of rockyard's multibody, ground and rocks are hard.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "math/pose.h"
#include "messages/wheels.h"
#include "rover/multibody/multibody.h"
#include "rover/part_shapes.h"
#include "rover/rover_layout_params.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// A fixed rock.
struct Ball {
  math::Vector3 center_W;
  double radius_m = 0.0;
};

// What a joint carries. Joints turn about y and have the numbers of multibody.h.
struct PeerLink {
  int parent = kChassis;
  math::Vector3 origin_R;
  BodyMass mass;
};

struct PeerScene {
  PeerScene(std::vector<Ball> rocks, double step, int sweeps)
      : balls(std::move(rocks)), step_s(step), iterations(sweeps) {
    const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
    const RoverMasses masses = MakeRoverMasses(params);
    chassis = masses.chassis;
    for (std::size_t side = 0; side < 2; ++side) {
      links[side] = {kChassis, geometry.rocker_pivot_R[side], masses.rocker};
      links[2 + side] = {static_cast<int>(side), geometry.bogie_pivot_R[side], masses.bogie};
    }
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      const int side = static_cast<int>(i / 3);
      links[kFirstWheel + i] = {geometry.on_bogie[i] ? kLeftBogie + side : kLeftRocker + side,
                                geometry.wheel_R[i], masses.wheel};
    }
    // Corners stand for boxes that have met the ground already: no peer needs them.
    for (const Part& part : MakeParts(params.geometry)) {
      if (part.margin_m > 0.0) parts.push_back(part);
    }
  }

  math::Vector3 FromParent(std::size_t joint) const {
    const int parent = links[joint].parent;
    if (parent == kChassis) return links[joint].origin_R;
    return links[joint].origin_R - links[static_cast<std::size_t>(parent)].origin_R;
  }

  RoverParams params{};
  std::vector<Ball> balls;
  double step_s;
  int iterations;
  BodyMass chassis;
  std::array<PeerLink, kJoints> links;
  std::vector<Part> parts;  // wheels meet ground and rocks, all others meet rocks
};

class Peer {
 public:
  virtual ~Peer() = default;
  // One step with all wheels driven at that rate.
  virtual void Step(double rate_rad_s) = 0;
  virtual math::Transform X_WR() const = 0;
  virtual messages::PerWheel<double> WheelAngles() const = 0;
};

// `firm`: elliptic cones, and friction of ten times the normal's impedance; otherwise its defaults.
std::unique_ptr<Peer> MakeMujoco(const PeerScene& scene, bool firm);
// `quick`: by sweeps, otherwise by its direct solver, which has no iterations.
std::unique_ptr<Peer> MakeOde(const PeerScene& scene, bool quick);
std::unique_ptr<Peer> MakeBullet(const PeerScene& scene);

}  // namespace rockyard::rover
