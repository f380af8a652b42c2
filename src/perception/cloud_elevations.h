// Between range points and light stripes: what lets either navigator work with either sensor. The
// readers of stereo and of light stripes use it. Records of drives depend on the bits of
// elevations, but not on the order of points: each elevation is the height of one point.
#pragma once

#include "messages/estimates.h"
#include "messages/measurements.h"
#include "messages/point_cloud.h"
#include "perception/eyes_params.h"
#include "perception/triangulation.h"

namespace rockyard::perception {

// Returns an elevation array for HazardDetector from range points: the ground ahead (or behind) is
// divided into rows x stripes equal bins, rows from near to far, stripes from the left to the right
// of whoever looks that way. The elevation of a bin is the quantile `quantile` of the heights of
// its points; with fewer than min_points the bin is undetected. The number is that of the cloud.
//
// The criteria were published for points 7 cm (rows) and 18 cm (stripes) apart on 20 cm of ground.
// On a slope, neighbours at the distance s differ by s tan(slope): thresholds (perception.hazard)
// must grow where the array is coarser. With the default blame the bin farther from the datum is
// charged. The highest point of a bin is the height of the rock in it: the threshold that belongs
// to it is what the vehicle can straddle.
//
// With ElevationFrame::kPlane heights count from the plane of the ground in the array, along its
// normal: a smooth slope is no step, and a rock on it as high as on the level.
//
// Cost: about 3 ns a point, with a plane a few times that.
messages::ElevationScan CloudElevations(const messages::PointCloud& cloud,
                                        const messages::AttitudeEstimate& attitude,
                                        const CloudElevationParams& params);

// Returns the points that a light stripe scan found, in R: at most one for each point of its array.
messages::PointCloud StripeCloud(const messages::StripeScan& scan,
                                 const Triangulator& triangulator);

}  // namespace rockyard::perception
