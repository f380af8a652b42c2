// A smoothed image, and where four squares of a chessboard may meet in it: saddle points of
// brightness with two dark and two bright sectors around them.
#pragma once

#include <optional>
#include <vector>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"

namespace rockyard::vision {

// The image convolved with a Gaussian of `sigma_px` > 0, cut at 3 sigma; edges are repeated.
Image<float> Smoothed(const GrayImage& image, double sigma_px);

// The bilinear value at a position; beyond the image that of the nearest pixel.
double ValueAt(const Image<float>& image, const Pixel& at);

// The candidates, each within about a pixel. `smooth` is the image smoothed by 1.5 px or so. A
// candidate is the largest I_xy^2 - I_xx I_yy (minus the determinant of the Hessian) within 3
// pixels and at least 2 % of the largest of the image, and brightness on a circle of 5 px about it
// goes up and down exactly twice, by 12 grey levels or more. Squares of 12 px and more are found.
std::vector<Pixel> CornerCandidates(const Image<float>& smooth);

// The corner near `start`, to sub-pixel: the point to which the edges around it run, that is the q
// with the least sum of w(p) (g(p) . (p - q))^2 over pixels p within `radius_px` of it (Foerstner
// and Guelch 1987), g the gradient by central differences, w a Gaussian about q of half the
// radius. The window follows q until it rests. The pattern around a corner looks the same after
// half a turn, which makes the estimate free of bias by symmetric blur and by the grid of pixels.
// Nothing where q leaves the image's inside or `start` by more than 3 px, or where the edges have
// one direction only. Image noise of sd n moves q by about n / (contrast sqrt(radius)) px.
std::optional<Pixel> RefineCorner(const GrayImage& image, const Pixel& start, double radius_px);

}  // namespace rockyard::vision
