// A simulated rover on a terrain: truth moves in answer to wheel commands. The world of a drive
// steps it, the command that renders stereo pairs puts it down to look, and doubts about scenarios
// let it drive a metre.
//
// Records depend on the last bit of this motion: another constant, order of contacts or order of
// sums is a change of results, which kept hashes of trials show. Both fidelities answer to the same
// parameters, and tests hold one against the other.
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
  // with wheels braked and straight; at the start, and when operators turn the rover by hand.
  virtual void Place(const math::Pose2& X_WR) = 0;

  // Advances the rover by one step of step_s() under the held set points. Where the motion is
  // simulated faster than it happens (physics.time_scale), the step is still counted in real time.
  virtual void Step(const messages::WheelCommand& command) = 0;

  // The length of one Step in real time, s.
  virtual double step_s() const = 0;
  // The real time in which the motors come from rest to the top speed, or back, s. Where the motion
  // is simulated faster than it happens, it is drive.ramp_s times physics.time_scale: inside, ramps
  // are as long as drive.ramp_s says, so that inertia does not tell.
  virtual double ramp_s() const = 0;
  // How many balances of forces were used that missed their tolerance, since the rover was made.
  virtual std::int64_t unconverged_balances() const { return 0; }
  // The true state after the last Place or Step: pose, velocities, joint angles, loads and
  // contacts.
  virtual const truth::RoverState& state() const = 0;
};

// Makes the rover of `params` on `terrain`, which must outlive it. Equal arguments give motion that
// is equal bit for bit. Rocks are fixed.
std::unique_ptr<Rover> MakeRover(const RoverParams& params, const terrain::Terrain& terrain);

// Makes a rover on rocks that slide when it pushes them harder than the soil holds them (see
// README.md of this folder): Place and Step move rocks of `terrain`. Only fidelity multibody can.
std::unique_ptr<Rover> MakeRover(const RoverParams& params,
                                 const terrain::RockHoldingParams& holding,
                                 terrain::Terrain& terrain);

}  // namespace rockyard::rover
