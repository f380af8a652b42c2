// One motion after another, with what is known of the sum.
#pragma once

#include "vision/odometry/motion_estimate.h"

namespace rockyard::vision {

// From A to C by way of B, the errors of both parts being independent and small. With the errors
// of MotionCovariance, each told in the first frame of its part,
//   e_r = e_rAB + R_AB e_rBC        e_t = e_tAB + R_AB e_tBC - [R_AB p_BC]x e_rAB,
// so that the covariance is J_AB C_AB J_AB' + J_BC C_BC J_BC', told in A.
Motion Compose(const Motion& A_to_B, const Motion& B_to_C);

}  // namespace rockyard::vision
