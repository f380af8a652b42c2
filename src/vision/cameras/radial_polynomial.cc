#include "vision/cameras/radial_polynomial.h"

#include <cmath>
#include <limits>

namespace rockyard::vision {
namespace {

constexpr int kMostUndistortSteps = 200;
constexpr double kUndistortTolerance = 2.0 * std::numeric_limits<double>::epsilon();
// The largest relative error of r' after the last step. A larger one means that r' lies beyond the
// end of the growing part.
constexpr double kLargestMiss = 1e-12;

// dr'/dr as a polynomial of t = r^2: c0 + 3 c1 t + 5 c2 t^2 + 7 c3 t^3.
double GrowthAt(const RadialPolynomial& polynomial, double t) {
  const auto& c = polynomial.c;
  return c[0] + t * (3.0 * c[1] + t * (5.0 * c[2] + t * 7.0 * c[3]));
}

}  // namespace

double Share(const RadialPolynomial& polynomial, double t) {
  const auto& c = polynomial.c;
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

double ShareSlope(const RadialPolynomial& polynomial, double t) {
  const auto& c = polynomial.c;
  return c[1] + t * (2.0 * c[2] + t * 3.0 * c[3]);
}

double Growth(const RadialPolynomial& polynomial, double r) { return GrowthAt(polynomial, r * r); }

bool GrowsUpTo(const RadialPolynomial& polynomial, double r) {
  const double end = r * r;
  if (!(polynomial.c[0] > 0.0 && GrowthAt(polynomial, end) > 0.0)) return false;
  // The growth is positive at both ends, and so between them unless its local minimum lies there.
  // The minimum of q0 + q1 t + q2 t^2 + q3 t^3 is at (sqrt(q2^2 - 3 q1 q3) - q2) / (3 q3), written
  // for q2 > 0 without the cancellation.
  const double q1 = 3.0 * polynomial.c[1];
  const double q2 = 5.0 * polynomial.c[2];
  const double q3 = 7.0 * polynomial.c[3];
  const double discriminant = q2 * q2 - 3.0 * q1 * q3;
  if (!(discriminant >= 0.0)) return true;
  const double root = std::sqrt(discriminant);
  const double minimum = q2 > 0.0 ? -q1 / (q2 + root) : (root - q2) / (3.0 * q3);
  return !(minimum > 0.0 && minimum < end) || GrowthAt(polynomial, minimum) > 0.0;
}

std::optional<double> Undistort(const RadialPolynomial& polynomial, double distorted) {
  if (!(polynomial.c[0] > 0.0 && distorted >= 0.0 && std::isfinite(distorted))) {
    return std::nullopt;
  }
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  double r = distorted / polynomial.c[0];
  for (int step = 0; step < kMostUndistortSteps; ++step) {
    const bool grows = GrowsUpTo(polynomial, r);
    const double excess = r * Share(polynomial, r * r) - distorted;
    (grows && excess <= 0.0 ? low : high) = r;
    double next = grows ? r - excess / Growth(polynomial, r) : high;
    if (!(next >= low && next < high)) next = std::isinf(high) ? 2.0 * r : 0.5 * (low + high);
    const bool done = std::fabs(next - r) <= kUndistortTolerance * next;
    r = next;
    if (done) break;
  }
  const double miss = std::fabs(r * Share(polynomial, r * r) - distorted);
  if (!(GrowsUpTo(polynomial, r) && miss <= kLargestMiss * distorted)) return std::nullopt;
  return r;
}

}  // namespace rockyard::vision
