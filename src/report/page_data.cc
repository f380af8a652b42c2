#include "report/page_data.h"

#include "report/page_json.h"
#include "report/summary_json.h"

namespace rockyard::report {

std::string PageJson(const PageHead& head, std::span<const std::string> runs,
                     std::span<const std::string> sweeps,
                     std::span<const std::string> comparisons) {
  return JsonObject()
      .AddInteger("version", 1)
      .AddText("title", head.title)
      .AddText("command", head.command)
      .AddText("why_none_published", head.why_none_published)
      .Add("provenance", JsonCompact(ProvenanceJson(head.provenance)))
      .Add("runs", JsonList(runs))
      .Add("sweeps", JsonList(sweeps))
      .Add("comparisons", JsonList(comparisons))
      .Text();
}

}  // namespace rockyard::report
