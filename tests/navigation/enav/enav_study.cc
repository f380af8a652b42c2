// What ACE passes that is not safe, from the map to the wheels: prints a line for each size of
// cells, error of heights and sinkage. scripts/studies/enav/enav.py makes a table of it. Also how
// far the stance in space leaves bounds that hold in ACE's own kinematics.
//
// Usage: enav_study chain|space GROUNDS
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "navigation/enav/stance.h"

namespace rockyard::navigation {
namespace {

constexpr double kFine_m = 0.025;
constexpr double kSide_m = 8.0;
constexpr int kPoses = 100;

math::Pose2 RandomPose(Draws& draws) {
  return {draws.Between(-1.5, 1.5), draws.Between(-1.5, 1.5),
          draws.Between(-std::numbers::pi, std::numbers::pi)};
}

HeightMap FineGround(Draws& draws) {
  return RandomGround(draws, kFine_m, kSide_m, draws.Between(0.0, 0.6), draws.Between(0.2, 0.6));
}

double Normal(Draws& draws) {
  return std::sqrt(-2.0 * std::log(draws.Between(1e-12, 1.0))) *
         std::cos(draws.Between(0.0, 2.0 * std::numbers::pi));
}

// The map that a rover has of it: means of the points of a cell, with an error that they share.
HeightMap Seen(HeightMap fine, double cell_m, double error_m, Draws& draws) {
  HeightMap map(cell_m, kSide_m);
  fine.ForEach([&](const LatticeCell& at, HeightCell& cell) {
    const LatticeCell to = map.CellOf(fine.MiddleX_m(at), fine.MiddleY_m(at));
    if (map.Holds(to)) map.At(to).Add(cell.Height_m());
  });
  map.ForEach([&](const LatticeCell&, HeightCell& cell) {
    if (cell.seen()) cell.sum_m += error_m * Normal(draws) * static_cast<double>(cell.points);
  });
  return map;
}

// From the underside of the chassis down to the ground, the least; the ground as its cells.
double Clearance_m(const messages::RoverBelief& rover, const math::Pose2& pose,
                   const Stance& stance, const HeightMap& fine) {
  const double facing = rover.suspension.bogies_at_front ? -1.0 : 1.0;
  const math::Transform X_WR =
      math::MakePose({pose.x_m, pose.y_m, -stance.origin_z_m}, pose.heading_rad,
                     -facing * stance.pitch_rad, stance.roll_rad);
  double least_m = std::numeric_limits<double>::infinity();
  for (double x = -0.5 * rover.suspension.belly_length_m;
       x <= 0.5 * rover.suspension.belly_length_m; x += kFine_m) {
    for (double y = -0.5 * rover.suspension.belly_width_m;
         y <= 0.5 * rover.suspension.belly_width_m; y += kFine_m) {
      const math::Vector3 p = X_WR * math::Vector3(x, y, rover.belly_clearance_m);
      least_m = std::min(least_m, p.z() - fine.At(fine.CellOf(p.x(), p.y())).Height_m());
    }
  }
  return least_m;
}

struct Broken {
  bool tilt = false, joints = false, clearance = false;

  bool any() const { return tilt || joints || clearance; }
};

Broken Breaks(const AceParams& params, const messages::RoverBelief& rover, const Stance& stance,
              double clearance_m) {
  Broken broken;
  broken.tilt =
      std::acos(std::cos(stance.roll_rad) * std::cos(stance.pitch_rad)) > params.max_tilt_rad;
  broken.joints = std::abs(stance.rocker_rad) > params.stop_share * rover.max_rocker_rad ||
                  std::abs(stance.bogie_rad[0]) > params.stop_share * rover.max_bogie_rad ||
                  std::abs(stance.bogie_rad[1]) > params.stop_share * rover.max_bogie_rad;
  broken.clearance = clearance_m < params.min_clearance_share * rover.belly_clearance_m;
  return broken;
}

void PrintChain(int grounds) {
  const messages::RoverBelief rover = PerseveranceLike();
  const AceParams params;
  const Ace ace(params, rover);
  std::puts(
      "cell_m,error_m,sinkage_m,poses,unsafe,passed,false_safe,tilt,joints,clearance,"
      "false_unsafe");
  for (const double cell_m : {0.05, 0.1, 0.2}) {
    for (const double error_m : {0.0, 0.01, 0.03}) {
      for (const double sinkage_m : {0.0, 0.03}) {
        int poses = 0, unsafe = 0, passed = 0, false_safe = 0, tilt = 0, joints = 0, clearance = 0,
            false_unsafe = 0;
        for (int g = 0; g < grounds; ++g) {
          Draws draws({1, static_cast<std::uint32_t>(g)}, 0);
          const HeightMap fine = FineGround(draws);
          const Ground ground = BetweenMiddles(fine);
          Draws errors({1, static_cast<std::uint32_t>(g)}, 1);
          const HeightMap map = Seen(fine, cell_m, error_m, errors);
          for (int p = 0; p < kPoses; ++p) {
            const math::Pose2 pose = RandomPose(draws);
            messages::PerWheel<double> sunk_m;
            for (double& sunk : sunk_m) sunk = sinkage_m * draws.Between(0.0, 1.0);
            const auto stance = SettleInSpace(rover, pose, ground, sunk_m);
            if (!stance) continue;
            const Broken broken =
                Breaks(params, rover, *stance, Clearance_m(rover, pose, *stance, fine));
            const bool safe = ace.Check(map, pose).safe();
            ++poses;
            unsafe += broken.any();
            passed += safe;
            false_safe += safe && broken.any();
            tilt += safe && broken.tilt;
            joints += safe && broken.joints;
            clearance += safe && broken.clearance;
            false_unsafe += !safe && !broken.any();
          }
        }
        std::printf("%g,%g,%g,%d,%d,%d,%d,%d,%d,%d,%d\n", cell_m, error_m, sinkage_m, poses, unsafe,
                    passed, false_safe, tilt, joints, clearance, false_unsafe);
      }
    }
  }
}

void PrintSpace(int grounds) {
  std::puts("diameters,poses,outside,mean_excess_deg,largest_excess_deg,largest_excess_m");
  const messages::RoverBelief rover = PerseveranceLike();
  for (const double diameters : {0.5, 1.0, 2.0}) {
    AceParams params;
    params.wheel_box_diameters = diameters;
    params.max_wheel_drop_radii = 0.0;
    const Ace ace(params, rover);
    int poses = 0, outside = 0;
    double sum_rad = 0.0, largest_rad = 0.0, largest_m = 0.0;
    for (int g = 0; g < grounds; ++g) {
      Draws draws({1, static_cast<std::uint32_t>(g)}, 0);
      const HeightMap fine = FineGround(draws);
      const Ground ground = BetweenMiddles(fine);
      for (int p = 0; p < kPoses; ++p) {
        const math::Pose2 pose = RandomPose(draws);
        const auto stance = SettleInSpace(rover, pose, ground);
        const AceVerdict verdict = ace.Check(fine, pose);
        if (!stance || verdict.failure == AceFailure::kLinkage) continue;
        const auto excess = [](const Interval& bound, double value) {
          return std::max({0.0, bound.low - value, value - bound.high});
        };
        const SuspensionState<Interval>& bound = verdict.state;
        const double angle_rad = std::max({excess(bound.roll_rad, stance->roll_rad),
                                           excess(bound.pitch_rad, stance->pitch_rad),
                                           excess(bound.rocker_rad, stance->rocker_rad),
                                           excess(bound.bogie_rad[0], stance->bogie_rad[0]),
                                           excess(bound.bogie_rad[1], stance->bogie_rad[1])});
        const double height_m = excess(bound.origin_z_m, stance->origin_z_m);
        ++poses;
        outside += angle_rad > 1e-9 || height_m > 1e-9;
        sum_rad += angle_rad;
        largest_rad = std::max(largest_rad, angle_rad);
        largest_m = std::max(largest_m, height_m);
      }
    }
    std::printf("%g,%d,%d,%.4f,%.3f,%.4f\n", diameters, poses, outside,
                math::RadToDeg(sum_rad / poses), math::RadToDeg(largest_rad), largest_m);
  }
}

int Main(std::string_view part, int grounds) {
  if (grounds <= 0 || (part != "chain" && part != "space")) return 2;
  part == "chain" ? PrintChain(grounds) : PrintSpace(grounds);
  return 0;
}

}  // namespace
}  // namespace rockyard::navigation

int main(int count, char** words) {
  return rockyard::navigation::Main(count > 2 ? words[1] : "", count > 2 ? std::atoi(words[2]) : 0);
}
