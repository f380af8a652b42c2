#include "rendering/picture/picture.h"

#include <limits>

namespace rockyard::rendering {

Picture::Picture(int columns, int rows)
    : radiance_w_m2_sr(columns, rows),
      range_m(columns, rows, std::numeric_limits<double>::infinity()),
      normal_W(columns, rows, Eigen::Vector3f::Zero()),
      surface(columns, rows, kBlind),
      sunlit(columns, rows) {}

}  // namespace rockyard::rendering
