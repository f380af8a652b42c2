// A simulated rover on a terrain: truth moves in answer to wheel commands.
//
// Every record of a drive hangs on the last bit of this motion: another constant, order of contacts
// or order of sums is a change of results, which kept hashes of trials show. Both fidelities answer
// to the same parameters, and tests hold one against the other.
#pragma once

#include <cstdint>
#include <memory>

#include "math/pose.h"
#include "messages/commands.h"
#include "rover/rover_params.h"
#include "terrain/rock_params.h"
#include "terrain/terrain.h"
#include "truth/rover_state.h"

namespace rockyard::rover {

// The interface of a simulated rover: every fidelity is one.
class Rover {
 public:
  virtual ~Rover() = default;

  // Puts the rover at rest at X_WR, above everything beneath it, and lets it settle on the terrain
  // with wheels braked and straight. Also used when operators turn the rover by hand.
  virtual void Place(const math::Pose2& X_WR) = 0;

  // Advances the rover by one step of step_s() under the held set points. Where the motion is
  // simulated faster than it happens (physics.time_scale), the step is still counted in real time.
  virtual void Step(const messages::WheelCommand& command) = 0;

  // The length of one Step in real time, s.
  virtual double step_s() const = 0;
  // The time in which the motors come from rest to the top speed, or back, s. Where the motion is
  // simulated faster than it happens, ramps are as long inside as drive.ramp_s says, so that
  // inertia does not tell, and so many times longer in real time.
  virtual double ramp_s() const = 0;
  // How often forces were used that had not been found to the tolerance, since the rover was made.
  virtual std::int64_t unconverged_balances() const { return 0; }
  // The true state after the last Place or Step: pose, velocities, joint angles, loads and
  // contacts.
  virtual const truth::RoverState& state() const = 0;
};

// Makes the rover of `params` on `terrain`, which must outlive it. One fresh world per call: equal
// arguments give bit-for-bit equal motion. Rocks are fixed.
std::unique_ptr<Rover> MakeRover(const RoverParams& params, const terrain::Terrain& terrain);

// Makes the same with rocks that slide when the rover pushes them harder than the soil holds them
// (see README.md of this folder): Place and Step then move rocks of `terrain`.
std::unique_ptr<Rover> MakeRover(const RoverParams& params,
                                 const terrain::RockHoldingParams& holding,
                                 terrain::Terrain& terrain);

}  // namespace rockyard::rover
