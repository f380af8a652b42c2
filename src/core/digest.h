// A digest that nobody can make another text for, by OpenSSL. Benchmarks tie entries, records and
// actions together by it; core/hash.h is for what nobody forges.
#pragma once

#include <string>
#include <string_view>

namespace rockyard::core {

// Returns the SHA-256 (FIPS 180-4) of the bytes: 64 lower-case hexadecimal digits.
std::string Sha256(std::string_view bytes);

}  // namespace rockyard::core
