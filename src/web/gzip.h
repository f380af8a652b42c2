// Compression that every browser undoes by itself (RFC 1952).
#pragma once

#include <string>
#include <string_view>

namespace rockyard::web {

// Equal bytes give equal bytes: no time and no name goes into the header. Throws std::runtime_error
// where memory is short.
std::string Gzip(std::string_view bytes);

}  // namespace rockyard::web
