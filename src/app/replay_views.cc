#include "app/replay_views.h"

#include <fmt/format.h>

#include <string_view>

#include "app/console.h"
#include "app/option_checks.h"
#include "app/progress_line.h"
#include "app/run_display.h"
#include "campaign/replay_moments.h"
#include "math/angles.h"
#include "report/line_text.h"
#include "report/navigation_drawing.h"
#include "report/scan_drawing.h"

namespace rockyard::app {
namespace {

std::string MomentLine(std::string_view what, std::int64_t number, const math::Pose2& pose,
                       std::string_view rest) {
  return fmt::format("  {} {:>5}   x {:>7.3f} m   y {:>7.3f} m   heading {:>7.1f} deg   {}\n", what,
                     number, pose.x_m, pose.y_m, math::RadToDeg(pose.heading_rad), rest);
}

void PrintScan(const campaign::ScanMoment& scan) {
  std::string stripes;
  for (const bool hazard : scan.stripe_hazard) stripes += hazard ? '#' : '.';
  Print(MomentLine("scan", scan.number, scan.pose, stripes));
}

void PrintStep(const campaign::StepMoment& step) {
  Print(MomentLine("step", step.view.step, step.pose,
                   report::ChosenText(step.view) + (step.view.looked_behind ? ", rear" : "")));
}

std::string Counted(const campaign::MomentsResult& result) {
  std::string text;
  if (result.scans > 0 || result.steps == 0) {
    text += fmt::format("  {} scans; --scan N draws one of them\n", result.scans);
  }
  if (result.steps > 0) {
    text += fmt::format("  {} steps; --step N draws one of them\n", result.steps);
  }
  return text;
}

// Prints the files of what stereo cameras saw of the step.
void PrintLooks(const campaign::MomentsResult& result) {
  if (!result.no_images.empty()) Print(fmt::format("  no images: {}\n", result.no_images));
  for (const campaign::LookFile& file : result.look_files) {
    Print(fmt::format("  {:<20} {}\n", file.name, file.what));
  }
}

void PrintDrawn(const campaign::MomentsResult& result) {
  const std::string folder = report::Printable(result.folder.string());
  if (result.scan) {
    Print(report::ScanText(*result.scan));
    Print(fmt::format("  images, array.svg and points.csv in {}\n", folder));
  }
  if (result.step) {
    Print(fmt::format("  {}\n  step.svg, map.csv, votes.csv and points.csv in {}\n",
                      report::ChosenText(*result.step), folder));
    PrintLooks(result);
  }
}

}  // namespace

ExitCode ShowViews(const ReplayOptions& options) {
  campaign::MomentsObserver observer;
  static_cast<campaign::Observer&>(observer) = MessagesToConsole(Output::kText);
  observer.scan = PrintScan;
  observer.step = PrintStep;
  const campaign::MomentsResult result = [&] {
    const BusyLine busy(fmt::format("driving trial {} again", options.request.trial));
    return campaign::ReplayMoments({.trial = options.request,
                                    .scan = options.scan,
                                    .step = options.step,
                                    .folder = options.out},
                                   observer);
  }();
  if (result.outcome == ExitCode::kDone || result.outcome == ExitCode::kDiffers) {
    PrintRepetition(result.repeats_stored, options.request.source);
  }
  if (options.draws()) {
    PrintDrawn(result);
  } else if (result.outcome != ExitCode::kBadInput && result.outcome != ExitCode::kFailed) {
    Print(Counted(result));
  }
  return result.outcome;
}

}  // namespace rockyard::app
