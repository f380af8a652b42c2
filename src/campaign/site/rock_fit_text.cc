#include <fmt/format.h>

#include <string>
#include <string_view>

#include "campaign/site/rock_fit.h"

namespace rockyard::campaign {

std::string RockFitText(const RockFit& fit) {
  std::string text = fmt::format("{} rocks from {:g} to {:g} m on {:g} m2", fit.rocks,
                                 fit.window.min_m, fit.window.max_m, fit.window.area_m2);
  if (fit.left_out > 0) text += fmt::format("; {} outside that range left out", fit.left_out);
  text += "\n\n";
  text += fmt::format("  {:<10} {:>10}   {:<22} {:>6}   {:>8}   {:>8}   {:>8}\n", "law", "value",
                      "95 % interval", "cover", "ln L", "p sizes", "p law");
  const auto row = [&](std::string_view name, const LawFit& law) {
    text +=
        fmt::format("  {:<10} {:10.5g}   {:<22} {:5.1f} %   {:8.2f}   {:8.3g}   {:8.3g}\n", name,
                    law.k, fmt::format("{:.5g} .. {:.5g}", law.interval.low, law.interval.high),
                    100.0 * law.expected_cover, law.log_likelihood, law.fit_p, law.against_p);
  };
  row("moore", fit.moore);
  row("golombek", fit.golombek);
  text += fmt::format(
      "\n  {}\n  Of {} catalogues that a law makes itself, p sizes is the share as far off by "
      "size, p "
      "law the share\n  that speaks as much for the other law.\n\n",
      fit.sentence, fit.catalogues);
  text += "  diameter [m]      seen   95 % of the mean      moore   golombek\n";
  for (const RockClass& c : fit.classes) {
    text +=
        fmt::format("  {:5.3f} .. {:5.3f} {:8}   {:<17} {:8.2f}   {:8.2f}\n", c.from_m, c.to_m,
                    c.observed, fmt::format("{:.1f} .. {:.1f}", c.interval.low, c.interval.high),
                    c.expected_moore, c.expected_golombek);
  }
  text += fmt::format(
      "\n  moore: terrain.rocks.k_per_m2 {:.5g}; golombek: terrain.rocks.cover {:.5g}\n",
      fit.moore.k, fit.golombek.k);
  if (fit.golombek.at_bound) {
    text += "  The cover is the largest or smallest that was looked at: do not use it.\n";
  }
  return text;
}

std::string RockFitCsv(const RockFit& fit) {
  std::string text = "from_m,to_m,observed,low,high,moore,golombek\n";
  for (const RockClass& c : fit.classes) {
    text += fmt::format("{},{},{},{},{},{},{}\n", c.from_m, c.to_m, c.observed, c.interval.low,
                        c.interval.high, c.expected_moore, c.expected_golombek);
  }
  return text;
}

}  // namespace rockyard::campaign
