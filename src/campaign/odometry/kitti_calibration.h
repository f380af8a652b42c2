// The cameras of KITTI's calib.txt.
#pragma once

#include <filesystem>

#include "vision/cameras/camera_file.h"

namespace rockyard::campaign {

// The first two projections of the file, a line each, as "P0: " and twelve numbers, or the numbers
// alone: the rows of P = [M | q] with (column, row, 1) ~ M p + q (KITTI's odometry benchmark). As
// CAHV: H, V and A are the rows of M and C = -M^-1 q; the outer frame is that of rectified camera 0
// (x right, y down, z ahead). The file does not know the size of the images. Other lines (P2, Tr)
// are passed over. Throws core::UserError: unreadable, fewer than two projections, a third row of M
// that is not 0 0 1, no focal length.
vision::CameraPair LoadKittiCalibration(const std::filesystem::path& path,
                                        const vision::ImageSize& size);

}  // namespace rockyard::campaign
