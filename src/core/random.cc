#include "core/random.h"

#include <Random123/philox.h>

namespace rockyard::core {

std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key) {
  r123::Philox4x32 generator;
  const r123::Philox4x32::ctr_type in{{counter[0], counter[1], counter[2], counter[3]}};
  const r123::Philox4x32::key_type k{{key[0], key[1]}};
  const auto out = generator(in, k);
  return {out[0], out[1], out[2], out[3]};
}

RandomStream::RandomStream(TrialKey key, Purpose purpose, std::uint32_t substream)
    : key_{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)},
      counter_{0, substream, static_cast<std::uint32_t>(purpose), key.trial} {}

std::uint32_t RandomStream::NextU32() {
  if (next_ == 4) {
    block_ = Philox4x32(counter_, key_);
    ++counter_[0];
    next_ = 0;
  }
  return block_[static_cast<std::size_t>(next_++)];
}

std::uint64_t RandomStream::NextU64() {
  const std::uint64_t high = NextU32();
  return (high << 32) | NextU32();
}

double RandomStream::Uniform() {
  constexpr double kCell = 0x1.0p-52;
  return (static_cast<double>(NextU64() >> 12) + 0.5) * kCell;
}

}  // namespace rockyard::core
