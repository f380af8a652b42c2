// Stands in for bundled_pages.cc where npm was missing when the program was built.
#include "web/bundled_pages.h"

namespace rockyard::web {

const std::string_view kReportPage;
const std::string_view kReplayPage;

}  // namespace rockyard::web
