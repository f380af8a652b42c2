#include "rover/multibody/loose_rocks.h"

#include <algorithm>

#include "terrain/rock.h"

namespace rockyard::rover {

using math::Vector3;

void LooseRock::PushBack(const Vector3& impulse_Ns) {
  // Newton's third law: du = -p / m in the plane. What lifts the rover, p_z > 0, loads the rock.
  v_W_m_s.head<2>() -= impulse_Ns.head<2>() / mass_kg;
  load_Ns += impulse_Ns.z();
}

LooseRocks::LooseRocks(const terrain::RockHoldingParams& params, double gravity_m_s2, double step_s,
                       terrain::Terrain& terrain)
    : params_(params), gravity_m_s2_(gravity_m_s2), step_s_(step_s), terrain_(terrain) {}

void LooseRocks::Clear() { rocks_.clear(); }

void LooseRocks::SetStep(double step_s) {
  for (LooseRock& rock : rocks_) rock.hold_Ns *= step_s / step_s_;
  step_s_ = step_s;
}

LooseRock* LooseRocks::Find(int index) {
  const auto found = std::find_if(rocks_.begin(), rocks_.end(),
                                  [index](const LooseRock& r) { return r.index == index; });
  return found == rocks_.end() ? nullptr : &*found;
}

void LooseRocks::Start(const std::vector<Contact>& contacts) {
  for (LooseRock& rock : rocks_) {
    rock.touched = false;
    rock.load_Ns = 0.0;
  }
  for (const Contact& contact : contacts) {
    if (contact.other < 0 || !contact.active) continue;
    LooseRock* rock = Find(contact.other);
    if (rock == nullptr) {
      const auto& shape = terrain_.rocks()[static_cast<std::size_t>(contact.other)];
      // A rock that is touched for the first time starts at rest, with no impulse of the soil.
      rocks_.push_back({.index = contact.other,
                        .mass_kg = terrain::RockMass(shape, params_.rock_density_kg_m3)});
      rock = &rocks_.back();
    }
    rock->touched = true;
  }
  std::erase_if(rocks_, [](const LooseRock& r) { return !r.touched && r.v_W_m_s.isZero(0.0); });
  // The soil starts from its impulse of the last step, as the contacts do.
  for (LooseRock& rock : rocks_) rock.v_W_m_s += rock.hold_Ns / rock.mass_kg;
}

void LooseRocks::Hold() {
  for (LooseRock& rock : rocks_) Hold(rock);
}

void LooseRocks::Hold(LooseRock& rock) const {
  // hold_Ns is already in the velocity, so the impulse that stops the rock is hold - m u. Along
  // this impulse the soil gives at most h F, where F holds a rock that is pushed the other way:
  // Coulomb's law, in one projection.
  const Vector3 wanted_Ns = rock.hold_Ns - rock.mass_kg * rock.v_W_m_s;
  const auto& shape = terrain_.rocks()[static_cast<std::size_t>(rock.index)];
  // The soil pushes along wanted_Ns, so the rock is pushed the other way; the load is that of this
  // sweep.
  const double max_Ns = step_s_ * terrain::HoldingForce(shape, params_, gravity_m_s2_,
                                                        rock.load_Ns / step_s_, -wanted_Ns);
  const double size_Ns = wanted_Ns.norm();
  if (size_Ns <= max_Ns) {
    rock.hold_Ns = wanted_Ns;
    rock.v_W_m_s.setZero();
    return;
  }
  const Vector3 hold_Ns = max_Ns / size_Ns * wanted_Ns;
  rock.v_W_m_s += (hold_Ns - rock.hold_Ns) / rock.mass_kg;
  rock.hold_Ns = hold_Ns;
}

void LooseRocks::Move(ContactFinder& finder) {
  for (const LooseRock& rock : rocks_) {
    if (rock.v_W_m_s.isZero(0.0)) continue;
    const Vector3 travel_m = step_s_ * rock.v_W_m_s;
    terrain_.MoveRock(rock.index, travel_m.x(), travel_m.y());
    finder.OnRockMoved(rock.index);
  }
}

}  // namespace rockyard::rover
