// Rocks that slide when the rover pushes them harder than the soil holds them: the part of the
// multibody's constraint solver that knows rocks as bodies (terrain.rocks.mobility movable).
// Records of other scenarios do not depend on it.
#pragma once

#include <vector>

#include "rover/multibody/contact_finder.h"
#include "terrain/rock_params.h"
#include "terrain/terrain.h"

namespace rockyard::rover {

// A rock that the rover touches, or that still slides: a mass that translates horizontally under
// the impulses of contacts and soil. The soil's is bounded by terrain::HoldingForce.
struct LooseRock {
  int index = 0;
  double mass_kg = 0.0;
  math::Vector3 v_W_m_s = math::Vector3::Zero();  // horizontal
  math::Vector3 hold_Ns = math::Vector3::Zero();  // horizontal, of the soil on the rock
  double load_Ns = 0.0;                           // downward impulse of the rover on the rock
  bool touched = false;                           // in this step

  // Gives the rock the opposite of the impulse that the rover receives; the soil takes the vertical
  // part.
  void PushBack(const math::Vector3& impulse_Ns);
};

// The loose rocks of one rover. A step calls Start, then in every sweep the contacts (which call
// PushBack) and Hold, then Move.
class LooseRocks {
 public:
  // The terrain must outlive this; Move moves its rocks. Draws no random numbers.
  LooseRocks(const terrain::RockHoldingParams& params, double gravity_m_s2, double step_s,
             terrain::Terrain& terrain);

  // Forgets velocities and impulses.
  void Clear();
  // Sets the length of the next steps.
  void SetStep(double step_s);
  // Takes up the rocks of the active contacts, and keeps those that still slide.
  void Start(const std::vector<Contact>& contacts);
  // Returns the rock with that index, or null where the contacts of Start do not touch it. It is
  // valid until the next Start.
  LooseRock* Find(int index);

  // Lets the soil take from every rock as much motion as the holding force can take in one step.
  void Hold();
  // Moves the rocks by one step of their velocities; `finder` learns where they are.
  void Move(ContactFinder& finder);

 private:
  void Hold(LooseRock& rock) const;

  const terrain::RockHoldingParams params_;
  const double gravity_m_s2_;
  double step_s_;
  terrain::Terrain& terrain_;
  std::vector<LooseRock> rocks_;  // in the order in which they were first touched
};

}  // namespace rockyard::rover
