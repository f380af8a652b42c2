// Radial distortion: r' = r (c0 + c1 r^2 + c2 r^4 + c3 r^6), on the part from the centre outwards
// where it grows.
//
// Beyond that part a lens would show one direction at two radii; no lens does, and calibrations say
// nothing there.
#pragma once

#include <array>
#include <optional>

namespace rockyard::vision {

struct RadialPolynomial {
  std::array<double, 4> c = {1.0, 0.0, 0.0, 0.0};
};

// c0 + c1 t + c2 t^2 + c3 t^3, t = r^2.
double Share(const RadialPolynomial& polynomial, double t);

// Its derivative by t.
double ShareSlope(const RadialPolynomial& polynomial, double t);

// The derivative of r' by r.
double Growth(const RadialPolynomial& polynomial, double r);

// Whether r' grows with r everywhere from 0 to r >= 0. False where anything is NaN.
bool GrowsUpTo(const RadialPolynomial& polynomial, double r);

// The r on the growing part with the given r' >= 0. Newton's method from r' / c0, kept within
// bisected bounds: at most 200 steps, to 4e-16 of r, usually 3 to 6. Nothing where the growing part
// ends below r', or where r' is not finite.
std::optional<double> Undistort(const RadialPolynomial& polynomial, double distorted);

}  // namespace rockyard::vision
