// Radial distortion r' = r (c0 + c1 r^2 + c2 r^4 + c3 r^6), for CAHVOR, CAHVORE and the pinhole
// with distortion. It holds on the growing part, from the centre outwards as far as r' grows with
// r: beyond, a lens would show two directions at one radius, and calibrations say nothing there. No
// record depends on it, as rovers' lenses are linear.
#pragma once

#include <array>
#include <optional>

namespace rockyard::vision {

struct RadialPolynomial {
  std::array<double, 4> c = {1.0, 0.0, 0.0, 0.0};
};

// Returns r' / r = c0 + c1 t + c2 t^2 + c3 t^3, t = r^2.
double Share(const RadialPolynomial& polynomial, double t);

// Returns the derivative of Share by t.
double ShareSlope(const RadialPolynomial& polynomial, double t);

// Returns the derivative of r' by r.
double Growth(const RadialPolynomial& polynomial, double r);

// Returns whether r' grows with r everywhere from 0 to r >= 0; false where anything is NaN.
bool GrowsUpTo(const RadialPolynomial& polynomial, double r);

// Returns the r on the growing part with the given r' >= 0, by Newton's method from r' / c0 within
// bisected bounds: at most 200 steps, usually 3 to 6, to 4e-16 of r. Returns nothing where the
// growing part ends below r', or where r' is not finite.
std::optional<double> Undistort(const RadialPolynomial& polynomial, double distorted);

}  // namespace rockyard::vision
