// Finds where the multibody touches, or is about to touch, the terrain, for the constraint solver.
// Both fidelities number what a part touches by the constants below.
#pragma once

#include <array>
#include <vector>

#include "math/pose.h"
#include "rover/ground_touches.h"
#include "rover/multibody/multibody.h"
#include "rover/part_shapes.h"
#include "rover/rock_body.h"
#include "terrain/terrain.h"

namespace rockyard::rover {

// What a part touches: a rock by its index >= 0, the ground (kGround), or wall i (kFirstWall - i).
// A wheel between the flanks of a ditch touches the ground twice; kGroundAhead is the place farther
// ahead. Must stay: contacts of a part are in the order of these numbers, in which pairs are found
// again from step to step and impulses are solved for.
inline constexpr int kGround = -1;
inline constexpr int kFirstWall = -2;
inline constexpr int kGroundAhead = -1000;

// A contact of a part with one thing. A contact is kept from step to step while the two stay near,
// so that its last impulses start the next solution.
struct Contact {
  int part = 0;
  int other = kGround;
  double gap_m = 0.0;                              // negative: penetration
  bool active = false;                             // may touch within this step
  math::Vector3 p_W = math::Vector3::Zero();       // on the rover
  math::Vector3 n_W = math::Vector3::UnitZ();      // from the terrain to the rover
  math::Vector3 along_W = math::Vector3::UnitX();  // rolling direction of a wheel, tangential
  math::Vector3 across_W = math::Vector3::UnitY();
  math::Vector3 near_W = math::Vector3::Zero();  // nearest point of the rock
  std::array<double, 3> impulse_Ns{};            // of the last step: along n_W, along_W, across_W
  double drag_Ns = 0.0;                          // of the last step: of the motion resistance
  double side_Ns = 0.0;                          // and of the soil at the side face

  bool IsSoil() const { return other == kGround || other == kGroundAhead; }
  void Forget() {
    impulse_Ns = {};
    drag_Ns = side_Ns = 0.0;
  }
};

// Keeps the list of contacts. Draws no random numbers.
class ContactFinder {
 public:
  ContactFinder(const RoverGeometryParams& params, const terrain::Terrain& terrain);

  // Updates contacts() for the present poses; they are in the order of part, then of `other`.
  void Update(const Multibody& body);
  // Forgets everything, for a rover that was lifted.
  void Clear();
  // Multiplies the impulses of all contacts, for a step whose length differs from the last one's.
  void ScaleImpulses(double ratio);
  // Takes the new place of a rock from the terrain.
  void OnRockMoved(int rock);

  std::vector<Contact>& contacts() { return contacts_; }
  const std::vector<Contact>& contacts() const { return contacts_; }
  const Part& part(int index) const { return parts_[static_cast<std::size_t>(index)]; }
  const std::vector<Part>& parts() const { return parts_; }

 private:
  void GatherRocks(const math::Vector3& p_WRo);
  void MeetGround(int index, const math::Transform& X_WB);
  // Meets walls and ground, of which a wheel may touch two places.
  void MeetWheelGround(int index, const math::Transform& X_WB);
  void AddGround(int index, int other, const GroundTouch& touch, const math::Transform& X_WB);
  void MeetWalls(int index, const math::Transform& X_WB);
  // plane: a point of the rock whose tangent plane has kept the part away, with the normal 0 where
  // none has; it is tried first.
  void MeetRock(int index, const math::Transform& X_WB, const math::Vector3& center_W, int rock,
                SurfacePoint& plane);
  // Returns whether the plane that touches a rock at that point of its surface keeps the part so
  // far away that the pair need not be followed.
  static bool AreApart(const Part& part, const math::Transform& X_WB, const SurfacePoint& surface);
  // Returns the point of a part that reaches farthest against n_W.
  static math::Vector3 Support(const Part& part, const math::Transform& X_WB,
                               const math::Vector3& n_W);
  // Adds a contact, with its state of the last step where there was one (`found`).
  Contact& Add(int part, int other, bool& found);
  void SetTangents(const math::Transform& X_WB, Contact& contact) const;

  const terrain::Terrain& terrain_;
  std::vector<Part> parts_;
  std::vector<RockBody> rocks_;
  double reach_m_;  // of the rover about R's origin
  std::vector<int> near_rocks_;
  std::vector<SurfacePoint> planes_;  // of the near rocks, for one part after the other
  math::Vector3 gathered_at_W_ = math::Vector3::Zero();
  bool gathered_ = false;
  std::vector<Contact> contacts_;
  std::vector<Contact> last_;
  std::size_t next_last_ = 0;
};

}  // namespace rockyard::rover
