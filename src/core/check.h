/// @file
/// Contracts for programmer errors: EXPECT for preconditions, ENSURE for postconditions. Every
/// module states them.
///
/// Active where ROCKYARD_CONTRACTS is defined (debug, sanitizer and test builds). A violation
/// throws ContractViolation, so that a batch records it as a simulator fault with seed and index
/// instead of losing the other trials. User errors never go through here: see core/error.h.
#pragma once

#include <stdexcept>
#include <string>

namespace rockyard::core {

/// What a violated contract throws: file, line and condition are in its message.
class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws ContractViolation. Only the macros below call it.
[[noreturn]] inline void FailContract(const char* kind, const char* condition, const char* file,
                                      int line) {
  throw ContractViolation(std::string(file) + ":" + std::to_string(line) + ": " + kind +
                          " violated: " + condition);
}

}  // namespace rockyard::core

#ifdef ROCKYARD_CONTRACTS
/// EXPECT: what a caller owes. ENSURE: what a function owes. Both are statements; the condition has
/// no side effects.
#define EXPECT(condition) \
  ((condition) ? void(0)  \
               : ::rockyard::core::FailContract("precondition", #condition, __FILE__, __LINE__))
#define ENSURE(condition) \
  ((condition) ? void(0)  \
               : ::rockyard::core::FailContract("postcondition", #condition, __FILE__, __LINE__))
#else
/// Without contracts the condition is compiled and never evaluated: what it names counts as used,
/// and the compiler finds the same errors in it as with contracts.
#define EXPECT(condition) (false ? void(condition) : void(0))
#define ENSURE(condition) (false ? void(condition) : void(0))
#endif
