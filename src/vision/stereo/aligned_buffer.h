// Memory for the loops in vectors of this folder and of visual odometry. It begins at a cache line,
// is zero at first unless asked otherwise, and has a cache line to spare at both ends: loops may
// load vectors that begin one value before the first (gradients, neighbouring segments of a row) or
// end behind the last. All three must stay: vectors are loaded aligned, and nobody writes the
// correlator's slot of zeros.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>

namespace rockyard::vision {

// What a buffer holds at first.
enum class Filled { kZero, kAnything };

template <typename Value>
class AlignedBuffer {
 public:
  static constexpr std::size_t kAlignment = 64;

  AlignedBuffer() = default;
  explicit AlignedBuffer(std::size_t size, Filled filled = Filled::kZero) : size_(size) {
    const std::size_t all = size + 2 * kSpare;
    memory_.reset(
        static_cast<Value*>(::operator new(all * sizeof(Value), std::align_val_t(kAlignment))));
    if (filled == Filled::kZero) std::fill_n(memory_.get(), all, Value{});
  }

  Value* data() { return memory_.get() + kSpare; }
  const Value* data() const { return memory_.get() + kSpare; }
  std::size_t size() const { return size_; }

 private:
  struct Release {
    void operator()(Value* memory) const {
      ::operator delete(memory, std::align_val_t(kAlignment));
    }
  };
  static constexpr std::size_t kSpare = kAlignment / sizeof(Value);

  std::unique_ptr<Value, Release> memory_;
  std::size_t size_ = 0;
};

// No vector of an instruction set in use has more lanes of Value.
template <typename Value>
constexpr std::size_t kMostLanes = 128 / sizeof(Value);

// Returns `count` rounded up to whole vectors, whatever their length.
template <typename Value>
constexpr std::size_t WholeVectors(std::size_t count) {
  return (count + kMostLanes<Value> - 1) / kMostLanes<Value> * kMostLanes<Value>;
}

}  // namespace rockyard::vision
