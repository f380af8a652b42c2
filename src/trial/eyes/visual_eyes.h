// The cameras of visual odometry on the world's side: a pose in, images out, or the motion that
// images would give. World looks with them, and the experiment that measures visual motions.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "core/random.h"
#include "math/pose.h"
#include "sensing/visual_motion.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"
#include "trial/eyes/rover_cameras.h"
#include "trial/sight/visual_reader.h"
#include "truth/rover_state.h"

namespace rockyard::trial {

// One interface for both fidelities (sensors.visual_odometry.fidelity). The error model stands for
// cameras and odometry together, keyframes included, as it has to know the true motion.
// Records depend on the numbers of looks, which name the noise, and on when keyframes begin.
class VisualEyes {
 public:
  // `drive`, `terrain` and `cameras` outlive it.
  VisualEyes(const DriveParams& drive, core::TrialKey key, const terrain::Terrain& terrain,
             RoverCameras& cameras);

  // Takes the next look, of a rover at X_WR; looks count from 0. A look costs 1 us, or as much as
  // two rendered images.
  MotionData Look(const math::Transform& X_WR);

  // Makes the next look a keyframe, as what was seen before is of no use any more. VisualReader and
  // VisualAid have to begin anew with it, as all three have to name the same look as keyframe.
  void Renew() { X_WK_.reset(); }
  void OnPlaced(const truth::RoverState& /*state*/) { Renew(); }

 private:
  VisualStep Model(const math::Transform& X_WR);
  bool IsFar(const math::Transform& X_KR) const;

  const sensing::VisualMotionParams& params_;
  sensing::VisualMotion motion_;
  const terrain::Terrain& terrain_;
  RoverCameras& cameras_;
  std::int64_t next_ = 0;
  std::int64_t keyframe_ = 0;            // of the error model
  std::optional<math::Transform> X_WK_;  // where the rover truly was at the keyframe
};

}  // namespace rockyard::trial
