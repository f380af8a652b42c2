// Where the quasi-static rover touches the terrain, or may touch it within its next stretch: the
// contacts of its balance of forces.
#pragma once

#include <array>
#include <vector>

#include "rover/multibody/contact_finder.h"
#include "rover/part_shapes.h"
#include "rover/quasi_static/linkage.h"
#include "rover/quasi_static/wheel_rock_gap.h"
#include "rover/rock_body.h"
#include "terrain/terrain.h"

namespace rockyard::rover {

// A contact of a part with one thing, as a balance of forces sees it.
struct RestingContact {
  int part = 0;         // index in MakeParts; wheels come first
  int other = kGround;  // a rock, kGround or a wall, as in contact_finder.h
  int body = kChassis;
  truth::BodyPart kind = truth::BodyPart::kWheel;
  double gap_m = 0.0;  // negative: penetration
  math::Vector3 p_W = math::Vector3::Zero();
  math::Vector3 n_W = math::Vector3::UnitZ();
  // The load in the last balance of forces; a contact that goes on starts from it.
  double load_N = 0.0;
  // The load that traction is taken from; it follows load_N from iteration to iteration.
  double traction_load_N = 0.0;
  // Along and across the wheel, in the last balance; a contact that goes on starts from it, too.
  std::array<double, 2> traction_N{};
  double sliding_speed_m_s = 0.0;
  double depth_m = 0.0;  // penetration at the end of the step, in the last balance

  bool IsWheel() const { return kind == truth::BodyPart::kWheel; }
  bool IsSoil() const { return IsWheel() && (other == kGround || other == kGroundAhead); }
};

// Finds the contacts of a rover in one posture. Draws no random numbers. Records depend on the
// order of the list, in which forces are summed: for each wheel ground, walls and rocks, then the
// body, then its corners.
class QuasiStaticContacts {
 public:
  QuasiStaticContacts(const RoverGeometryParams& params, const terrain::Terrain& terrain);

  // Finds every contact nearer than reach_m. Loads of contacts that go on are kept.
  void Update(const Linkage& linkage, double reach_m);
  // Returns false where no rock or wall can be nearer than reach_m to a rover at p_WR. It is much
  // cheaper than Update, and may return true in vain.
  bool MayMeetObstacle(const math::Vector3& p_WR, double reach_m);
  // Returns false where no rock or wall can be nearer than reach_m to a wheel; it is tighter than
  // MayMeetObstacle.
  bool WheelMayMeetObstacle(const Linkage& linkage, double reach_m);
  // Forgets everything, for a rover that was lifted.
  void Clear();

  std::vector<RestingContact>& contacts() { return contacts_; }
  const std::vector<RestingContact>& contacts() const { return contacts_; }

 private:
  // A rock near the rover.
  struct NearRock {
    int index = 0;
    RockSupport support;
    RockBody body;
    messages::PerWheel<math::Vector3> wheel_normal_W;  // the last gap's, from which the next starts
    messages::PerWheel<bool> known{};                  // whether wheel_normal_W is set
  };

  // The parts rock_parts_[first] to [last - 1], which belong to one body, and a ball that holds
  // them.
  struct BodyParts {
    int body = kChassis;
    std::size_t first = 0;
    std::size_t last = 0;
    math::Vector3 center_B;
    double radius_m = 0.0;
    math::Vector3 center_W = math::Vector3::Zero();  // in the posture at hand
    Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();
    double way_m = 0.0;  // at most so far has any of its points gone since the rocks were gathered
  };

  void Gather(const math::Vector3& p_WR);
  bool IsNear(const math::Vector3& center_W, std::size_t wheel, double reach_m,
              const NearRock& rock) const;
  math::Vector3 WheelSupport(const Linkage& linkage, std::size_t wheel,
                             const math::Vector3& n_W) const;
  void MeetWalls(const Linkage& linkage, std::size_t wheel, double reach_m);
  void MeetGround(const Linkage& linkage, std::size_t wheel, double reach_m);
  void MeetRock(const Linkage& linkage, std::size_t wheel, double reach_m, NearRock& rock);
  void MeetBody(const Linkage& linkage, double reach_m);
  void PlaceBodies(const Linkage& linkage);
  // Meets the parts of a body that may be near; until_m are theirs of clear_until_m_.
  void MeetParts(const Linkage& linkage, const BodyParts& body, double reach_m,
                 const NearRock& rock, double* until_m);
  // Returns the gap between a part and a rock, or a lower bound of it beyond reach_m.
  double MeetPart(const Linkage& linkage, std::size_t index, double reach_m, const NearRock& rock);
  void MeetCorners(const Linkage& linkage, double reach_m);
  void Add(const RestingContact& contact);

  const terrain::Terrain& terrain_;
  const WheelShape wheel_;
  const std::vector<Part> parts_;
  const double reach_R_m_;  // of the rover about R's origin
  const double hub_radius_m_;
  std::vector<int> near_;
  std::vector<NearRock> rocks_;
  std::vector<std::size_t> rock_parts_;  // those of parts_ beside the wheels that rocks can touch
  std::vector<BodyParts> bodies_;
  // By rock, and for each by part of rock_parts_: the way_m of its body up to which it does not
  // come near the rock.
  std::vector<double> clear_until_m_;
  math::Vector3 gathered_at_W_ = math::Vector3::Zero();
  bool gathered_ = false;
  std::vector<RestingContact> contacts_;
  std::vector<RestingContact> last_;
};

}  // namespace rockyard::rover
