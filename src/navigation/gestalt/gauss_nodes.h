// Nodes of Gauss-Legendre quadrature over [-1, 1] (Abramowitz and Stegun 1964, table 25.4).
#pragma once

#include <array>

namespace rockyard::navigation {

// The nodes -place and +place, each with the weight.
struct GaussPair {
  double place;
  double weight;
};

inline constexpr std::array<GaussPair, 2> kFourNodes{
    {{0.3399810435848563, 0.6521451548625461}, {0.8611363115940526, 0.3478548451374538}}};
inline constexpr std::array<GaussPair, 4> kEightNodes{{{0.1834346424956498, 0.3626837833783620},
                                                       {0.5255324099163290, 0.3137066458778873},
                                                       {0.7966664774136267, 0.2223810344533745},
                                                       {0.9602898564975363, 0.1012285362903763}}};

}  // namespace rockyard::navigation
