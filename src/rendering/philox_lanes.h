// Philox 4x32-10 for many counters side by side: what noise of whole lines is drawn by.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace rockyard::rendering {

// Writes the words of core::Philox4x32 of counters that follow each other in their first word, as
// halves of 16 bits, the lower one first: eight a block, of as many blocks as fill `halves`, whose
// size must be a multiple of eight. The first word must not run over. It is the same on every
// processor: whole numbers only.
void PhiloxHalves(const std::array<std::uint32_t, 4>& counter,
                  const std::array<std::uint32_t, 2>& key, std::span<std::uint16_t> halves);

}  // namespace rockyard::rendering
