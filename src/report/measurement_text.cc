// The cells of a measurement for people and as CSV (summary_text.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text.h"
#include "report/line_text.h"
#include "report/result_table.h"
#include "report/run_description.h"
#include "report/summary_text.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using statistics::Cell;
using statistics::MeasurementSummary;

// More cells than this are pooled (MeasurementText).
constexpr std::size_t kMaxUnpooled = 40;
// Columns of numbers that fit into 100 characters.
constexpr std::size_t kMaxColumns = 7;

std::string Head(const RunDescription& run, const MeasurementSummary& summary, TextStyle style) {
  const std::string name = Cut(Printable(run.scenario), 40);
  std::string text = style == TextStyle::kPlain ? name : "\x1b[1m" + name + "\x1b[0m";
  text += fmt::format(", seed {}: {} of {} runs", run.seed, summary.completed, run.planned);
  if (summary.cells.size() != 1) text += fmt::format(", {} cells", summary.cells.size());
  text += "\n";
  text += SettingsText(run);
  if (run.stored > summary.completed) {
    text += fmt::format("  {} more finished runs count once those before them are finished\n",
                        run.stored - summary.completed);
  }
  text += AccountingText(run);
  if (summary.faults > 0) {
    text += fmt::format("  {} simulator faults, in none of the numbers below\n", summary.faults);
  }
  return text;
}

std::string Bases(const MeasurementSummary& summary) {
  std::string text;
  for (std::size_t i = 0; i < summary.bases.size(); ++i) {
    double low = summary.cells.front().bases[i];
    double high = low;
    for (const Cell& cell : summary.cells) {
      low = std::min(low, cell.bases[i]);
      high = std::max(high, cell.bases[i]);
    }
    text += fmt::format("  {} a cell: {:.6g}", summary.bases[i].name, low);
    text += high > low ? fmt::format(" .. {:.6g}\n", high) : "\n";
  }
  return text;
}

std::string Widest(const MeasurementSummary& summary, std::size_t rate) {
  if (rate == summary.rates.size()) return "";
  return fmt::format("  widest 95 % interval of {}: {:.4f}\n", summary.rates[rate].name,
                     summary.WidestInterval(rate));
}

// Adds names to a line that is broken where it grows too long.
std::string Listed(const std::string& head, const std::vector<std::string>& names) {
  std::string text = head;
  for (const std::string& name : names) text += (&name == names.data() ? "" : ", ") + name;
  return names.empty() ? "" : Wrapped(text + "\n");
}

std::size_t LongestName(const MeasurementSummary& summary) {
  std::size_t longest = 0;
  for (const auto* list : {&summary.rates, &summary.means}) {
    for (const truth::ValueInfo& column : *list) longest = std::max(longest, column.name.size());
  }
  return longest;
}

// The rates of the cell that are shares of `of`, each with its interval.
std::string SharesOf(const MeasurementSummary& summary, std::string_view of, std::size_t width) {
  std::string text;
  std::vector<std::string> never;
  std::int64_t base = 0;
  double highest = 0.0;  // of those that never happened
  for (std::size_t i = 0; i < summary.rates.size(); ++i) {
    const statistics::Proportion& rate = summary.cells.front().rates[i].rate;
    if (summary.rates[i].of != of || rate.trials == 0) continue;
    base = rate.trials;
    if (rate.count == 0) {
      never.push_back(summary.rates[i].name);
      highest = std::max(highest, rate.interval.high);
      continue;
    }
    text += fmt::format("    {:<{}} {:5.1f} %  {:.1f} .. {:.1f}\n", summary.rates[i].name, width,
                        100.0 * rate.rate, 100.0 * rate.interval.low, 100.0 * rate.interval.high);
  }
  if (text.empty() && never.empty()) return "";
  text += Listed(fmt::format("    never (up to {:.1f} %): ", 100.0 * highest), never);
  return fmt::format("  of {} {}, with 95 % intervals\n", base, of) + text;
}

// A cell alone: everything that it measured, by what it is a share of.
std::string OnlyCell(const MeasurementSummary& summary) {
  const std::size_t width = LongestName(summary);
  const Cell& cell = summary.cells.front();
  std::string text;
  for (std::size_t i = 0; i < summary.factors.size(); ++i) {
    text += fmt::format("  {} {:.6g}\n", summary.factors[i].name, cell.factors[i]);
  }
  for (std::size_t i = 0; i < summary.bases.size(); ++i) {
    const std::string& base = summary.bases[i].name;
    const auto is_of = [&](const truth::ValueInfo& rate) { return rate.of == base; };
    if (std::none_of(summary.rates.begin(), summary.rates.end(), is_of)) {
      text += fmt::format("  {} {:.6g}\n", base, cell.bases[i]);
    }
  }
  for (std::size_t i = 0; i < summary.rates.size(); ++i) {
    const std::string& of = summary.rates[i].of;
    const auto same = [&](const truth::ValueInfo& rate) { return rate.of == of; };
    const auto first = std::find_if(summary.rates.begin(), summary.rates.end(), same);
    if (&*first == &summary.rates[i]) text += SharesOf(summary, of, width);
  }
  std::vector<std::string> zero;
  std::string means;
  for (std::size_t i = 0; i < summary.means.size(); ++i) {
    const truth::ValueInfo& column = summary.means[i];
    const double mean = summary.cells.front().means[i];
    if (mean == 0.0) {
      zero.push_back(column.name);
    } else if (std::isfinite(mean)) {
      const bool squares = column.role == truth::ColumnRole::kSquares;
      means += fmt::format("    {:<{}} {:>8}  of {}{}\n", column.name, width, FourDigits(mean),
                           column.of, squares ? ", root mean square" : "");
    }
  }
  means += Listed("    0: ", zero);
  return means.empty() ? text : text + "  means\n" + means;
}

std::string CellLine(const Cell& cell) {
  std::string line = " ";
  for (std::size_t i = 0; i < std::min(kMaxFactors, cell.factors.size()); ++i) {
    line += fmt::format(" {:>8.4g}", cell.factors[i]);
  }
  std::size_t room = kMaxColumns;
  for (const statistics::CellRate& rate : cell.rates) {
    if (room-- == 0) return line + "\n";
    line += fmt::format(" {:>9.4f}", rate.rate.rate);
  }
  for (const double mean : cell.means) {
    if (room-- == 0) return line + "\n";
    line += fmt::format(" {:>9.3g}", mean);
  }
  return line + "\n";
}

std::string EveryCell(const MeasurementSummary& summary) {
  // Names are longer than their columns: a letter each, explained above the table.
  std::string legend;
  std::string header = " ";
  char letter = 'A';
  const auto add = [&](std::string_view name, std::size_t width) {
    legend += fmt::format("  {} {}\n", letter, name);
    header += fmt::format(" {:>{}}", letter++, width);
  };
  for (std::size_t i = 0; i < std::min(kMaxFactors, summary.factors.size()); ++i) {
    add(summary.factors[i].name, 8);
  }
  std::size_t room = kMaxColumns;
  for (const auto* list : {&summary.rates, &summary.means}) {
    for (const truth::ValueInfo& column : *list) {
      if (room == 0) break;
      --room;
      const bool mean = column.role == truth::ColumnRole::kSum;
      const bool squares = column.role == truth::ColumnRole::kSquares;
      add(fmt::format("{}{}", mean ? "mean " : squares ? "rms " : "", column.name), 9);
    }
  }
  std::string text = legend + header + "\n";
  for (const Cell& cell : summary.cells) text += CellLine(cell);
  return text;
}

// Rows: first factor. Columns: second factor. Counts and bases are added up over the others.
std::string Pooled(const MeasurementSummary& summary, std::size_t rate) {
  std::map<std::pair<double, double>, std::pair<double, double>> pooled;
  std::vector<double> rows;
  std::vector<double> columns;
  for (const Cell& cell : summary.cells) {
    const double row = cell.factors[0];
    const double column = cell.factors.size() > 1 ? cell.factors[1] : 0.0;
    auto& [count, base] = pooled[{row, column}];
    count += static_cast<double>(cell.rates[rate].rate.count);
    base += static_cast<double>(cell.rates[rate].rate.trials);
    if (std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(row);
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) {
      columns.push_back(column);
    }
  }
  columns.resize(std::min<std::size_t>(columns.size(), 9));
  std::string text = fmt::format("  {} by {} (down) and {} (across), all other factors together\n",
                                 summary.rates[rate].name, summary.factors[0].name,
                                 summary.factors.size() > 1 ? summary.factors[1].name : "-");
  text += fmt::format("  {:>9}", "");
  for (const double column : columns) text += fmt::format(" {:>8.4g}", column);
  text += "\n";
  for (const double row : rows) {
    text += fmt::format("  {:>9.4g}", row);
    for (const double column : columns) {
      const auto& [count, base] = pooled[{row, column}];
      text += base > 0.0 ? fmt::format(" {:>8.3f}", count / base) : fmt::format(" {:>8}", "-");
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::size_t MainRate(const truth::RecordSchema& rates) {
  const auto main = std::find_if(rates.begin(), rates.end(), [](const truth::ValueInfo& rate) {
    return rate.role == truth::ColumnRole::kMainCount;
  });
  return static_cast<std::size_t>(main - rates.begin());
}

std::string MeasurementText(const RunDescription& run, const MeasurementSummary& summary,
                            TextStyle style) {
  std::string text = Head(run, summary, style);
  if (!summary.cells.empty()) {
    const std::size_t rate = MainRate(summary.rates);
    const bool pool = summary.cells.size() > kMaxUnpooled && rate < summary.rates.size();
    if (summary.cells.size() == 1) {
      text += OnlyCell(summary);
    } else {
      text += Bases(summary) + Widest(summary, rate);
      text += pool ? Pooled(summary, rate) : EveryCell(summary);
      text += "  intervals of every cell, and of all cells at once, in cells.csv\n";
    }
  }
  return text + fmt::format("  trial hash {}\n", run.trial_hash);
}

std::string CellsCsv(const statistics::MeasurementSummary& summary) {
  CsvRow head("cell", "runs");
  for (const truth::ValueInfo& factor : summary.factors) head.Add(factor.name);
  for (const truth::ValueInfo& base : summary.bases) head.Add(base.name);
  for (const truth::ValueInfo& rate : summary.rates) {
    for (const char* suffix : {"", "_low", "_high", "_all_low", "_all_high"}) {
      head.Add(rate.name + suffix);
    }
  }
  for (const truth::ValueInfo& mean : summary.means) {
    const bool squares = mean.role == truth::ColumnRole::kSquares;
    head.Add((squares ? "rms_" : "mean_") + mean.name);
  }
  std::string csv = head.Line();
  for (const statistics::Cell& cell : summary.cells) {
    CsvRow row(cell.number, cell.runs, cell.factors, cell.bases);
    for (const statistics::CellRate& rate : cell.rates) {
      row.Add(rate.rate.rate, rate.rate.interval, rate.simultaneous);
    }
    csv += row.Add(cell.means).Line();
  }
  return csv;
}

namespace {

// Pixels.
constexpr double kPanelWidth = 190.0;
constexpr double kPanelHeight = 130.0;
constexpr double kLeft = 60.0;
constexpr double kTop = 70.0;
constexpr double kGap = 34.0;

double FactorOf(const Cell& cell, std::size_t factor) {
  return factor < cell.factors.size() ? cell.factors[factor] : 0.0;
}

std::vector<double> ValuesOf(const MeasurementSummary& summary, std::size_t factor) {
  std::vector<double> values;
  for (const Cell& cell : summary.cells) values.push_back(FactorOf(cell, factor));
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t IndexOf(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) -
                                  values.begin());
}

class Drawing {
 public:
  Drawing(const MeasurementSummary& summary, std::size_t rate)
      : summary_(summary), rate_(rate), x_(ValuesOf(summary, 0)) {
    for (std::size_t factor = 1; factor < 4; ++factor) {
      split_[factor - 1] = ValuesOf(summary, factor);
    }
  }

  std::string Draw(const std::string& title) const {
    const auto [columns, curves, rows] = split_;
    const double width = kLeft + static_cast<double>(columns.size()) * (kPanelWidth + kGap) + 20.0;
    const double height = kTop + static_cast<double>(rows.size()) * (kPanelHeight + 2 * kGap) + 20;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"11\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        "<text x=\"12\" y=\"20\" font-size=\"14\">{}: {} against {}, bands of 95 %</text>\n",
        width, height, core::EscapeXml(title), summary_.rates[rate_].name,
        summary_.factors[0].name);
    svg += Legend(curves);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      for (std::size_t column = 0; column < columns.size(); ++column) {
        svg += Panel(row, column);
      }
    }
    return svg + "</svg>\n";
  }

 private:
  double X(std::size_t column, double value) const {
    const double share = (value - x_.front()) / (x_.back() - x_.front());
    return kLeft + static_cast<double>(column) * (kPanelWidth + kGap) + share * kPanelWidth;
  }
  static double Y(std::size_t row, double rate) {
    return kTop + static_cast<double>(row) * (kPanelHeight + 2 * kGap) +
           (1.0 - rate) * kPanelHeight;
  }

  std::string Label(std::size_t factor, double value) const {
    return factor < summary_.factors.size()
               ? fmt::format("{} {:.4g}", summary_.factors[factor].name, value)
               : std::string();
  }

  std::string Legend(const std::vector<double>& curves) const {
    std::string svg;
    if (summary_.factors.size() < 3) return svg;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      svg +=
          fmt::format("<text x=\"{:.0f}\" y=\"40\" fill=\"{}\">{}</text>\n",
                      12.0 + 170.0 * static_cast<double>(i), CurveColour(i), Label(2, curves[i]));
    }
    return svg;
  }

  std::string Panel(std::size_t row, std::size_t column) const {
    const double left = X(column, x_.front());
    const double top = Y(row, 1.0);
    std::string svg =
        SvgBox(left, top, kPanelWidth, kPanelHeight, "fill=\"none\" stroke=\"#999\"") +
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{} {}</text>\n", left, top - 4.0,
                    Label(1, split_[0][column]), Label(3, split_[2][row]));
    for (const double tick : {0.0, 0.5, 1.0}) {
      svg += SvgStyledText(left - 3.0, Y(row, tick) + 4.0, fmt::format("{:g}", tick),
                           "text-anchor=\"end\"");
    }
    for (const double tick : {x_.front(), x_.back()}) {
      svg += SvgStyledText(X(column, tick), Y(row, 0.0) + 14.0, fmt::format("{:.4g}", tick),
                           "text-anchor=\"middle\"");
    }
    for (std::size_t curve = 0; curve < split_[1].size(); ++curve) svg += Curve(row, column, curve);
    return svg;
  }

  std::string Curve(std::size_t row, std::size_t column, std::size_t curve) const {
    std::map<double, const Cell*> along;  // by the first factor
    for (const Cell& cell : summary_.cells) {
      const bool here = IndexOf(split_[0], FactorOf(cell, 1)) == column &&
                        IndexOf(split_[1], FactorOf(cell, 2)) == curve &&
                        IndexOf(split_[2], FactorOf(cell, 3)) == row;
      if (here && cell.rates[rate_].rate.trials > 0) along[cell.factors[0]] = &cell;
    }
    std::vector<SvgBandPoint> points;
    for (const auto& [value, cell] : along) {
      const statistics::Proportion& rate = cell->rates[rate_].rate;
      points.push_back({X(column, value), Y(row, rate.rate), Y(row, rate.interval.low),
                        Y(row, rate.interval.high)});
    }
    const std::string_view colour = CurveColour(curve);
    return SvgBand(points, colour, 0.25, fmt::format("stroke=\"{}\"", colour));
  }

  const MeasurementSummary& summary_;
  std::size_t rate_;
  std::vector<double> x_;
  std::array<std::vector<double>, 3> split_;  // columns, curves, rows
};

}  // namespace

std::string CellsSvg(const MeasurementSummary& summary, const std::string& title) {
  const std::size_t rate = MainRate(summary.rates);
  if (summary.cells.empty() || summary.factors.empty() || rate == summary.rates.size()) return "";
  if (ValuesOf(summary, 0).size() < 2) return "";
  return Drawing(summary, rate).Draw(title);
}

}  // namespace rockyard::report
