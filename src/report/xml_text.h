// Text inside XML and SVG files.
#pragma once

#include <string>
#include <string_view>

namespace rockyard::report {

// Characters that XML takes for its own are written as entities, control characters as blanks: fit
// for elements and for quoted attributes.
std::string EscapeXml(std::string_view text);

}  // namespace rockyard::report
