#include "core/normal_pieces.h"

#include <cmath>
#include <span>

namespace rockyard::core {
namespace {

constexpr std::size_t kSeries = 18;  // terms by which z goes from a middle to the next one
constexpr long double kRootOf2Pi = 2.506628274631000502415765284811045253L;

using Series = std::array<long double, kSeries>;

// Fills in the terms of z about a point from z and z' there: (k + 1)(k + 2) a[k + 2] is term k of
// z z'^2.
void Complete(Series& a) {
  Series slopes{};   // z'
  Series squares{};  // z'^2
  for (std::size_t k = 0; k + 2 < kSeries; ++k) {
    slopes[k] = static_cast<long double>(k + 1) * a[k + 1];
    for (std::size_t i = 0; i <= k; ++i) squares[k] += slopes[i] * slopes[k - i];
    long double term = 0.0L;
    for (std::size_t i = 0; i <= k; ++i) term += a[i] * squares[k - i];
    a[k + 2] = term / static_cast<long double>((k + 1) * (k + 2));
  }
}

// Returns z and z' at a distance from the point of a series.
std::array<long double, 2> At(const Series& a, long double distance) {
  long double value = 0.0L;
  long double slope = 0.0L;
  for (std::size_t k = kSeries; k-- > 0;) {
    slope = slope * distance + value;
    value = value * distance + a[k];
  }
  return {value, slope};
}

}  // namespace

// From 1/2 downwards, piece by piece.
NormalPieces::NormalPieces() : pieces_(kPieces) {
  long double at = 0.5L;
  Series series{0.0L, -kRootOf2Pi};
  Complete(series);
  for (std::size_t i = kPieces; i-- > 0;) {
    const long double octave = std::ldexp(1.0L, static_cast<int>(i >> kPieceBits) + kFirstOctave);
    constexpr long double kPerOctave = 1 << kPieceBits;
    const auto part = static_cast<long double>(i % (1U << kPieceBits));
    // The last piece is about its end, 1/2, so that z keeps its digits where it goes to 0.
    const bool last = i + 1 == kPieces;
    const long double half_width = (last ? 1.0L : 0.5L) * octave / kPerOctave;
    const long double middle = octave * (1.0L + (part + (last ? 1.0L : 0.5L)) / kPerOctave);
    const auto [value, slope] = At(series, middle - at);
    at = middle;
    series = {value, slope};
    Complete(series);
    Piece& piece = pieces_[i];
    piece.middle = static_cast<double>(middle);
    piece.inverse_half_width = static_cast<double>(1.0L / half_width);
    long double power = 1.0L;
    for (std::size_t k = 0; k < kTerms; ++k) {
      piece.coefficients[k] = static_cast<double>(series[k] * power);
      power *= half_width;
    }
  }
}

}  // namespace rockyard::core
