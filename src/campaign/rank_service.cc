#include "campaign/rank_service.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <set>
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
#include "experiments/make_experiment.h"
#include "scenario/load.h"

namespace rockyard::campaign {
namespace {

// Beside those of batch/distributed.cc.
constexpr int kCampaign = 10;  // build, then of each cell: fingerprint, resolved scenario, seed
constexpr int kEnd = 11;       // outcome
constexpr int kEnds = 12;      // to rank 0, in answer

constexpr std::chrono::milliseconds kPause{2};

void SendToAll(batch::Communicator& communicator, int tag, const std::string& bytes) {
  for (int rank = 1; rank < communicator.size(); ++rank) {
    if (!communicator.given_up().contains(rank)) communicator.Send(rank, tag, bytes);
  }
}

// The ranks that have not said that they end after so much time.
std::set<int> RanksThatStay(batch::Communicator& communicator, std::chrono::milliseconds silence) {
  std::set<int> ranks;
  for (int rank = 1; rank < communicator.size(); ++rank) {
    if (!communicator.given_up().contains(rank)) ranks.insert(rank);
  }
  const auto start = std::chrono::steady_clock::now();
  while (!ranks.empty()) {
    const std::optional<batch::Message> message = communicator.Poll();
    if (message && message->tag == kEnds) ranks.erase(message->rank);
    if (message) continue;
    if (silence.count() > 0 && std::chrono::steady_clock::now() - start > silence) break;
    std::this_thread::sleep_for(kPause);
  }
  return ranks;
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

void Serve(batch::Communicator& communicator, const std::string& campaign,
           const ContainmentOptions& options, const Contact& contact) {
  batch::FlightLog log;
  const ReceivedWork received(campaign, log);
  batch::OverdueTrials overdue;
  const batch::Watchdog watchdog(
      log, {.cpu_limit_s = options.trial_cpu_limit_s},
      [&](const std::vector<batch::Flight>& flights) { overdue.Tell(batch::TrialsOf(flights)); });
  const std::shared_ptr<void> watch = contact.stop.Watch(log.stop(), SecondWish::kIsTheSame);
  batch::ServeBatch(communicator, received.work(), options.threads, log.stop(), overdue);
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

void EndRanks(batch::Communicator& communicator, Outcome outcome, std::chrono::milliseconds silence,
              Journal& journal) {
  SendToAll(communicator, kEnd,
            batch::PacketWriter().Integer(static_cast<std::int64_t>(outcome)).bytes());
  for (const int rank : RanksThatStay(communicator, silence)) {
    journal.Warn(fmt::format("rank {} does not end and is given up", rank));
    communicator.GiveUp(rank);
  }
  if (!communicator.given_up().empty()) communicator.Abort(static_cast<int>(outcome));
}

Outcome ServeRankZero(batch::Communicator& communicator, const ContainmentOptions& options,
                      const Contact& contact) {
  try {
    for (;;) {
      const batch::Message message = WaitForMessage(communicator);
      if (message.tag == kEnd) {
        communicator.Send(0, kEnds, {});
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
