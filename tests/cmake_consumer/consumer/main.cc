// Uses headers and code of several modules of an installed rockyard.
#include <cstdio>

#include "core/random.h"
#include "navigation/navigator.h"
#include "truth/rover_state.h"

int main() {
  // Known answer of Philox 4x32-10 for the zero counter under the zero key (Random123,
  // kat_vectors).
  const auto block = rockyard::core::Philox4x32({}, {});
  const rockyard::navigation::NavigatorDecision decision;
  const rockyard::truth::RoverState state;
  const bool right = block[0] == 0x6627e8d5U &&
                     decision.status == rockyard::navigation::NavigatorStatus::kDriving &&
                     state.contacts.empty();
  std::puts(right ? "consumer: ok" : "consumer: wrong values");
  return right ? 0 : 1;
}
