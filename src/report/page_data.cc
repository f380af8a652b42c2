#include "report/page_data.h"

#include "core/json_pieces.h"
#include "core/json_text.h"
#include "report/summary_json.h"

namespace rockyard::report {

std::string PageJson(const PageHead& head, std::span<const std::string> runs,
                     std::span<const std::string> sweeps,
                     std::span<const std::string> comparisons) {
  return core::JsonObject()
      .AddInteger("version", 1)
      .AddText("title", head.title)
      .AddText("command", head.command)
      .AddText("why_none_published", head.why_none_published)
      .Add("provenance", core::CompactJson(ProvenanceJson(head.provenance)))
      .Add("runs", core::JsonList(runs))
      .Add("sweeps", core::JsonList(sweeps))
      .Add("comparisons", core::JsonList(comparisons))
      .Text();
}

}  // namespace rockyard::report
