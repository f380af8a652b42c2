// Bytes as text, for pages and for messages to processes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rockyard::core {

// Return bytes as text (RFC 4648, section 4), with padding, without line breaks.
std::string Base64(std::span<const std::uint8_t> bytes);
std::string Base64(std::string_view bytes);

}  // namespace rockyard::core
