#include "campaign/rank_service.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "batch/distributed.h"
#include "batch/flight_log.h"
#include "batch/logged_experiment.h"
#include "batch/packet.h"
#include "batch/watchdog.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "experiments/experiment.h"
#include "scenario/load.h"

namespace rockyard::campaign {
namespace {

// Beside those of batch/distributed.cc.
constexpr int kCampaign = 10;  // build, then of each cell: fingerprint, resolved scenario, seed
constexpr int kEnd = 11;       // outcome

constexpr std::chrono::milliseconds kPause{2};

void SendToAll(batch::Communicator& communicator, int tag, const std::string& bytes) {
  for (int rank = 1; rank < communicator.size(); ++rank) communicator.Send(rank, tag, bytes);
}

batch::Message WaitForMessage(batch::Communicator& communicator) {
  for (;;) {
    if (std::optional<batch::Message> message = communicator.Poll()) return std::move(*message);
    std::this_thread::sleep_for(kPause);
  }
}

// The cells of a campaign, made from what rank 0 says of them.
class ReceivedWork {
 public:
  ReceivedWork(const std::string& bytes, batch::FlightLog& log) {
    batch::PacketReader packet(bytes);
    CheckBuild(packet.Text());
    for (std::int64_t left = packet.Integer(); left > 0; --left) {
      const std::string fingerprint = packet.Text();
      const std::string resolved = packet.Text();
      AddCell(fingerprint, resolved, static_cast<std::uint64_t>(packet.Integer()), log);
    }
  }

  std::span<const batch::CellWork> work() const { return work_; }

 private:
  static void CheckBuild(const std::string& build) {
    if (build == BuildName()) return;
    throw core::UserError(
        "build", fmt::format("is \"{}\" on this rank and \"{}\" on rank 0", BuildName(), build),
        "start the same program on machines of the same CPU level");
  }

  void AddCell(const std::string& fingerprint, const std::string& resolved, std::uint64_t seed,
               batch::FlightLog& log) {
    const scenario::Scenario scenario =
        scenario::ReadScenario(core::ParseJson(resolved, "scenario from rank 0"));
    if (core::Hex(scenario::Fingerprint(scenario)) != fingerprint) {
      throw core::UserError("scenario", "is another one on this rank than on rank 0", "");
    }
    const auto cell = static_cast<int>(work_.size());
    plain_.push_back(experiments::MakeExperiment(scenario.experiment, scenario.drive));
    logged_.push_back(std::make_unique<batch::LoggedExperiment>(*plain_.back(), cell, log));
    work_.push_back({logged_.back().get(), seed});
  }

  std::vector<std::unique_ptr<experiments::Experiment>> plain_;
  std::vector<std::unique_ptr<batch::LoggedExperiment>> logged_;
  std::vector<batch::CellWork> work_;
};

// MPI ends the other ranks as soon as one ends without saying so.
[[noreturn]] void EndJob(Journal& journal, const std::vector<core::Problem>& problems) {
  journal.Fail(problems);
  _exit(static_cast<int>(Outcome::kFailed));
}

void EndLate(Journal& journal, const std::vector<batch::Flight>& overdue) {
  std::vector<core::Problem> problems;
  problems.reserve(overdue.size());
  for (const batch::Flight& flight : overdue) {
    problems.push_back({fmt::format("trial {} of cell {}", flight.id.trial, flight.id.cell),
                        "used more CPU time than --trial-cpu-limit, and is pending",
                        "go on with --resume and without mpirun, which tries it again alone"});
  }
  EndJob(journal, problems);
}

void Serve(batch::Communicator& communicator, const std::string& campaign,
           const ContainmentOptions& options, const Contact& contact) {
  batch::FlightLog log;
  const ReceivedWork received(campaign, log);
  const batch::Watchdog watchdog(
      log, {.cpu_limit_s = options.trial_cpu_limit_s},
      [&](const std::vector<batch::Flight>& overdue) { EndLate(contact.journal, overdue); });
  const std::shared_ptr<void> watch = contact.stop.Watch(log.stop(), SecondWish::kIsTheSame);
  batch::ServeBatch(communicator, received.work(), options.threads, log.stop());
}

}  // namespace

void StartRanks(batch::Communicator& communicator, const batch::CampaignIdentity& campaign) {
  batch::PacketWriter packet;
  packet.Text(campaign.build).Integer(static_cast<std::int64_t>(campaign.cells.size()));
  for (const batch::CellIdentity& cell : campaign.cells) {
    packet.Text(cell.fingerprint).Text(cell.resolved);
    packet.Integer(static_cast<std::int64_t>(cell.seed));
  }
  SendToAll(communicator, kCampaign, packet.bytes());
}

void EndRanks(batch::Communicator& communicator, Outcome outcome) {
  SendToAll(communicator, kEnd,
            batch::PacketWriter().Integer(static_cast<std::int64_t>(outcome)).bytes());
}

Outcome ServeRankZero(batch::Communicator& communicator, const ContainmentOptions& options,
                      const Contact& contact) {
  try {
    for (;;) {
      const batch::Message message = WaitForMessage(communicator);
      if (message.tag == kEnd) {
        return static_cast<Outcome>(batch::PacketReader(message.bytes).Integer());
      }
      Serve(communicator, message.bytes, options, contact);
    }
  } catch (const core::UserError& error) {
    EndJob(contact.journal, error.problems());
  } catch (const std::exception& error) {
    EndJob(contact.journal, {{"rockyard", error.what(), ""}});
  }
}

}  // namespace rockyard::campaign
