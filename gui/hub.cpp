#include "gui/hub.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "gui/replies.h"
#include "gui/update.h"
#include "protocol/problem_json.h"

namespace spacetime::gui {
namespace {

using protocol::Client;

// Runs that can still be cancelled; older ones have been answered long since.
constexpr std::size_t most_runs = 16;

Client::Callbacks callbacks(bool symbolic, const std::function<void(Event)>& push) {
  return {[symbolic, push](Client::State state, const std::string& why) {
    using Condition = Daemon::Condition;
    const Condition condition = state == Client::State::ready  ? Condition::ready
                                : state == Client::State::lost ? Condition::lost
                                                               : Condition::starting;
    push(DaemonIs{symbolic, condition, why});
  }};
}

// A window that closes waits so long for the disk; what is not saved by then stays in the journal.
constexpr std::chrono::seconds longest_farewell{5};

Event answered(int number, Request::Answer answer, const std::string& text, const protocol::Reply& reply) {
  if (!reply.error.is_null()) return Refused{number, reply.error.value("message", "refused without a reason")};
  try {
    using Kind = Request::Answer;
    switch (answer) {
      case Kind::scene:
        return compiled_from(number, text, reply.result);
      case Kind::done:
      case Kind::run:
        return done_from(number, reply.result);
      case Kind::reached:
      case Kind::checkpoint:
        return reached_from(number, reply.result, answer == Kind::checkpoint);
      case Kind::sampled:
        return sampled_from(number, reply.result);
      case Kind::answered:
        return answered_from(number, reply.result);
      case Kind::acknowledged:
        return Acknowledged{number};
    }
  } catch (const std::exception& error) {
    return Refused{number, std::string("the daemon's answer is not as the protocol says: ") + error.what()};
  }
  return Acknowledged{number};
}

// The problem as the optimizer holds it: actions are sent one by one, and whatever is declared has taken effect.  So
// the same statements make the same document, and a checkpoint of the one can be set in the other.
Problem held(Problem problem) {
  problem.actions.clear();
  for (Constraint& constraint : problem.constraints) constraint.since = 0;
  for (Term& term : problem.objective) term.since = 0;
  for (Keyframe& keyframe : problem.keyframes) keyframe.since = 0;
  return problem;
}

}  // namespace

protocol::Target daemon_beside(const std::string& name) {
  const std::string program = "spacetime-" + name;
  std::error_code error;
  const auto beside = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / program;
  const bool there = !error && ::access(beside.c_str(), X_OK) == 0;
  return {{there ? beside.string() : program, "serve"}, {}, {}};
}

Hub::Hub(HubOptions options) : wake_(std::move(options.wake)) {
  const auto queue = [this](Event event) { post(std::move(event)); };
  filming_ = std::make_unique<Filming>(queue);
  disk_ = std::make_unique<Disk>(std::move(options.folder), queue);
  symbolic_ = std::make_unique<Client>(std::move(options.symbolic), callbacks(true, queue));
  optimizer_ = std::make_unique<Client>(std::move(options.optimizer), callbacks(false, queue));
}

Hub::~Hub() = default;

void Hub::post(Event event) {
  {
    const std::lock_guard lock(mutex_);
    // Progress that nobody has taken yet becomes one: the queue does not grow while nobody looks.
    auto* later = std::get_if<Iterated>(&event);
    auto* earlier = later && !queue_.empty() ? std::get_if<Iterated>(&queue_.back()) : nullptr;
    if (earlier && earlier->number == later->number) {
      merge(*earlier, std::move(*later));
    } else {
      queue_.push_back(std::move(event));
    }
  }
  if (wake_) wake_();
}

bool Hub::step(double seconds) {
  std::vector<Event> events;
  {
    const std::lock_guard lock(mutex_);
    events.swap(queue_);
  }
  const std::size_t notices = state_.notices.size();
  for (const Event& event : events) apply(event);
  apply(Tick{seconds});
  return !events.empty() || state_.playback.playing || notices != state_.notices.size();
}

void Hub::apply(const Event& event) {
  for (Effect& effect : update(state_, event)) {
    if (const auto* request = std::get_if<Request>(&effect)) {
      perform(*request);
    } else if (const auto* cancel = std::get_if<Cancel>(&effect)) {
      perform(*cancel);
    } else if (const auto* film = std::get_if<MakeFilm>(&effect)) {
      filming_->perform(*film);
    } else if (std::holds_alternative<StopFilm>(effect)) {
      filming_->stop();
    } else {
      disk_->perform(std::move(effect));
    }
  }
}

void Hub::perform(const Request& request) {
  std::string params = "{" + request.params;
  if (request.problem) {
    Writer to(false);
    write(to, held(*request.problem));
    params += (request.params.empty() ? "" : ",") + std::string("\"problem\":") + to.take();
  }
  params += "}";
  const int number = request.number;
  const auto reply = [this, number, answer = request.answer, text = request.text](const protocol::Reply& got) {
    post(answered(number, answer, text, got));
  };
  Client::Progress progress;
  const bool runs = request.answer == Request::Answer::run;
  if (runs) {
    progress = [this, number](const Json& value) {
      try {
        post(iterated_from(number, value));
      } catch (const InputError&) {
        // The next one may be as the protocol says; the outcome will tell.
      }
    };
  }
  const int id = (request.symbolic ? symbolic_ : optimizer_)->ask(request.method, std::move(params), reply, progress);
  if (!runs) return;
  runs_[number] = id;
  if (runs_.size() > most_runs) runs_.erase(runs_.begin());
}

void Hub::perform(const Cancel& cancel) {
  const auto run = runs_.find(cancel.number);
  if (run != runs_.end()) optimizer_->cancel(run->second);
}

void Hub::close(bool discard) {
  step(0);
  disk_->wait(longest_farewell);  // saving, most often
  step(0);
  disk_->perform(JournalEnd{would_lose(state_) && !discard});
}

}  // namespace spacetime::gui
