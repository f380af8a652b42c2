// Bytes as text (RFC 4648, section 4).
#pragma once

#include <string>
#include <string_view>

namespace rockyard::web {

// With padding, without line breaks.
std::string Base64(std::string_view bytes);

}  // namespace rockyard::web
