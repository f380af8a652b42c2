// The inverse of the normal distribution by pieces, for samplers: some ten nanoseconds where
// NormalQuantile takes up to a hundred.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rockyard::core {

// z(t), the standard normal number that is exceeded with probability t, from kLeast to below 1/2.
// It solves z'' = z z'^2 with z(1/2) = 0, z'(1/2) = -sqrt(2 pi), as z' = -sqrt(2 pi) exp(z^2 / 2).
// Each of 16 pieces between two powers of two has its Taylor polynomial about its middle. The
// series converges within the distance to t = 0, which is 33 times the piece's half width or more:
// what is cut off is smaller than rounding. Only sums, products and quotients make it, so that its
// bits hang on no library of functions.
//
// Nearer to 0 the rounding of the first pieces would show: an error of t matters by its share of t.
class NormalPieces {
 public:
  static constexpr double kLeast = 0x1p-10;

  NormalPieces();

  // Returns z(t) to 4e-16 of 1 + z.
  double Exceeded(double t) const {
    const Piece& piece = pieces_[PieceOf(t)];
    const auto& a = piece.coefficients;
    const double x = (t - piece.middle) * piece.inverse_half_width;
    const double x2 = x * x;
    const double x4 = x2 * x2;
    const double low = (a[0] + a[1] * x) + (a[2] + a[3] * x) * x2;
    const double middle = (a[4] + a[5] * x) + (a[6] + a[7] * x) * x2;
    const double high = (a[8] + a[9] * x) + a[10] * x2;
    return low + (middle + high * x4) * x4;
  }

 private:
  static constexpr int kPieceBits = 4;  // 16 pieces an octave
  static constexpr int kFirstOctave = -10;
  static constexpr int kOctaves = 9;  // up to 2^-1
  static constexpr std::size_t kPieces = std::size_t{kOctaves} << kPieceBits;
  static constexpr std::size_t kTerms = 11;

  struct Piece {
    std::array<double, kTerms> coefficients;  // of powers of (t - middle) / half width
    double middle;
    double inverse_half_width;
  };

  // The exponent of a number and the first bits behind its leading one name its piece, counted from
  // kLeast.
  static std::size_t PieceOf(double t) {
    constexpr int kMantissaBits = 52;
    constexpr std::uint64_t kFirst = std::uint64_t{1023 + kFirstOctave} << kPieceBits;
    return (std::bit_cast<std::uint64_t>(t) >> (kMantissaBits - kPieceBits)) - kFirst;
  }

  std::vector<Piece> pieces_;
};

}  // namespace rockyard::core
