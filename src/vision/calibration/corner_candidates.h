// The first steps of FindChessboard (find_chessboard.h): a smoothed image, and where four squares
// may meet in it, which are saddle points of brightness with two dark and two bright sectors around
// them. No record depends on them: tests hold how near and how complete the corners are.
#pragma once

#include <optional>
#include <vector>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"

namespace rockyard::vision {

// Returns the image convolved with a Gaussian of `sigma_px` > 0, cut at 3 sigma; edges are
// repeated.
Image<float> Smoothed(const GrayImage& image, double sigma_px);

// Returns the bilinear value at a position; beyond the image the value at its nearest edge.
double ValueAt(const Image<float>& image, const Pixel& at);

// Returns the candidates, each within about a pixel. `smooth` is the image smoothed by about
// 1.5 px. At a candidate I_xy^2 - I_xx I_yy (minus the determinant of the Hessian) is the largest
// within 3 pixels and more than 2 % of the image's largest, and brightness on a circle of 5 px
// about it goes up and down exactly twice, by 12 grey levels or more. Squares of 12 px and more are
// found.
std::vector<Pixel> CornerCandidates(const Image<float>& smooth);

// Returns the corner near `start` to sub-pixel accuracy: the point q to which the edges around it
// run, that is the one with the least sum of w(p) (g(p) . (p - q))^2 over pixels p within
// `radius_px` of q (Foerstner and Guelch 1987). g is the gradient by central differences, w a
// Gaussian about q whose standard deviation is half the radius. The window follows q until q rests.
// The pattern around a corner looks the same after half a turn, so that symmetric blur and the grid
// of pixels cause no bias. Returns nothing where q leaves the image's inside or is more than 3 px
// from `start`, or where the edges have one direction only. Image noise of standard deviation n
// moves q by about n / (contrast sqrt(radius)) px.
std::optional<Pixel> RefineCorner(const GrayImage& image, const Pixel& start, double radius_px);

}  // namespace rockyard::vision
