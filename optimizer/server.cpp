#include "optimizer/server.h"

#include <fmt/format.h>

#include <chrono>
#include <limits>
#include <memory>

#include "common/assert.h"
#include "common/diagnostic.h"
#include "optimizer/refine.h"
#include "optimizer/server_limits.h"
#include "optimizer/server_progress.h"
#include "optimizer/server_sample.h"
#include "optimizer/session.h"
#include "protocol/action_json.h"
#include "protocol/check.h"
#include "protocol/declared.h"
#include "protocol/measure.h"
#include "protocol/memory.h"
#include "protocol/motion_json.h"
#include "protocol/openrpc.h"
#include "protocol/problem_json.h"

namespace spacetime::optimizer {
namespace {

using protocol::Call;
using protocol::Code;
using protocol::Error;
using protocol::Turn;

// A solve or iterate that goes on.
constexpr double slowest = 0.1, fastest = 1000;  // iterations a second that can be asked for

struct Run {
  Solve rest;     // what is left of it, an `iterate` being a solve with that many iterations
  int since = 0;  // the iteration at which its last edit, or itself, began
  int begun = 0;  // ... itself, as the motion counts now
  bool edited = false;

  bool many() const { return rest.starts > 1; }  // its starts go on at their own pace
};

// An action whose parameters are in order, but which cannot be done here.
Error refused(const Action& action, const std::string& why) {
  if (const auto* set = std::get_if<SetConstant>(&action); set && set->value.program.empty()) {
    return {Code::refused, fmt::format("\"{}\" cannot be {:.9g}: {}", set->constant, set->value.number, why),
            protocol::path_data("/action/value")};
  }
  return {Code::refused, why, protocol::path_data("/action")};
}

PlacedAction placed(const Solve& solve) {
  // An `iterate` is a solve to the usual tolerance.
  Solve plain;
  plain.iterations = solve.iterations;
  if (solve.iterations && solve == plain) return {Iterate{*solve.iterations}, {}};
  return {solve, {}};
}

class Peer {
 public:
  explicit Peer(const protocol::Allowance& allowance) : allowance_(allowance) {}

  void load(const Node& params, Writer& result) {
    params.object({"problem"}, {"revision"});
    Problem problem = checked_problem(params["problem"], allowance_);
    const double unknowns = count_unknowns(problem);
    session_ = std::make_unique<Session>(std::move(problem), std::nullopt, std::numeric_limits<int>::max());
    fingerprint_.clear();
    result.member("unknowns", static_cast<int>(unknowns));
  }

  void update(const Node& params, Writer& result) {
    params.object({"problem"}, {"revision"});
    Session& session = present();
    Problem problem = checked_problem(params["problem"], allowance_);
    session.update(std::move(problem), allowance_.unknowns);
    fingerprint_.clear();
    write_edit(result, {});
  }

  void act(const Node& params, Writer& result, Call& call) {
    params.object({"action"}, {"revision", "progress", "pace"});
    const auto pace = params.find("pace");
    if (pace && !(pace->number() >= slowest && pace->number() <= fastest))
      pace->expected(fmt::format("a number from {} to {}", slowest, fastest));
    Session& session = present();
    const Node node = params["action"];
    const PlacedAction asked = action_from(node);
    if (const auto fault = validate(asked.action, session.problem())) {
      throw DocumentError("params", "/action" + fault->path, fault->message);
    }
    if (const auto* refine = std::get_if<Refine>(&asked.action))
      require_room(session.problem(), most_of(*refine), allowance_);
    const bool edit = is_edit(asked.action);
    SPACETIME_ASSERT(edit || !run_);
    try {
      edit ? session.perform(asked.action) : run(asked.action, pace ? pace->number() : 0, result, call);
    } catch (const InputError& error) {
      throw refused(asked.action, error.what());
    }
    if (edit) write_edit(result, {asked});
  }

  void get(const Node& params, Writer& result) {
    params.object({}, {"checkpoint", "multipliers", "revision"});
    Session& session = present();
    const auto checkpoint = params.find("checkpoint"), multipliers = params.find("multipliers");
    if (run_) session.stop("Going on: this is iteration " + std::to_string(session.iterations()) + ".");
    Motion motion = session.motion();
    if (multipliers && multipliers->boolean()) motion.multipliers = session.multipliers();
    if (checkpoint && checkpoint->boolean()) {
      motion.checkpoint = session.checkpoint();
      if (fingerprint_.empty()) fingerprint_ = fingerprint(session.original());
      motion.checkpoint->problem = fingerprint_;
      write_log(result, {});
    }
    result.key("motion");
    write(result, motion);
  }

  void set(const Node& params, Writer& result) {
    params.object({"motion"}, {"revision"});
    Session& session = present();
    const Motion motion = motion_from(params["motion"]);
    if (const auto fault = validate(motion)) throw DocumentError("params", "/motion" + fault->path, fault->message);
    double unknowns = 0;
    for (const Trajectory& dof : motion.dofs) unknowns += dof.basis.size();
    if (unknowns > allowance_.unknowns) throw beyond("unknowns", allowance_, unknowns);
    if (const auto fault = validate(motion, session.original())) {
      throw DocumentError("params", "/motion" + fault->path, fault->message);
    }
    const int before = session.iterations();
    try {
      session.set_motion(motion);
    } catch (const CheckpointError& error) {
      throw DocumentError("params", "/motion" + error.path(), error.message());
    }
    write_edit(result, {}, before);
    if (!run_) return;
    run_->since = session.iterations();  // what comes is counted on from the motion's own number
    run_->begun += session.iterations() - before;
  }

  void sample(const Node& params, Writer& result) { answer_sample(params, present(), allowance_, result); }

 private:
  Session& present() const {
    if (!session_) throw Error(Code::no_problem, "there is no problem yet: send \"problem/load\" first");
    return *session_;
  }

  // What must be performed to come to the same bits: the iterations of a run that goes on up to here, then `done`.
  // Messages other than actions follow what they write here.  What is left of a run after its last such message is
  // logged at its end.
  void write_log(Writer& result, std::vector<PlacedAction> done, int iteration) {
    result.member("iteration", iteration);
    result.key("log");
    result.list([&] {
      if (run_ && !run_->many() && iteration > run_->since) {
        Solve part = run_->rest;
        part.iterations = iteration - run_->since;
        write(result, placed(part));
        run_->rest.iterations = run_->rest.iterations.value_or(default_iterations) - *part.iterations;
        run_->since = iteration;
      }
      for (const PlacedAction& action : done) write(result, action);
    });
  }

  void write_log(Writer& result, std::vector<PlacedAction> done) {
    write_log(result, std::move(done), session_->iterations());
  }

  void write_edit(Writer& result, std::vector<PlacedAction> done, int iteration) {
    if (run_) run_->edited = true;
    write_log(result, std::move(done), iteration);
  }
  void write_edit(Writer& result, std::vector<PlacedAction> done) {
    write_edit(result, std::move(done), session_->iterations());
  }

  // `pace`: at most so many iterations a second; 0: as fast as it can.
  void run(const Action& action, double pace, Writer& result, Call& call) {
    Session& session = *session_;
    const int number = ++runs_;
    bool stopped = false;
    const auto show = [&, untold = std::make_shared<Untold>()](const IterationRecord& record) {
      const int serial = untold->add(record);
      call.progress([iterate = Snapshot{number, serial, record, untold, session.trajectories(), session.parameters()},
                     shown = shown_] { return iterate.text(*shown); });
    };
    Watch watch;
    watch.progress = show;
    watch.around = [account = protocol::account_of_thread()](const auto& work) {
      const protocol::Sharing sharing(account);
      work();
    };
    Run run;
    if (const auto* solve = std::get_if<Solve>(&action)) run.rest = *solve;
    if (const auto* iterate = std::get_if<Iterate>(&action)) run.rest.iterations = iterate->iterations;
    run.since = run.begun = session.iterations();
    run_ = run;
    using Clock = Call::Clock;
    const std::chrono::duration<double> apart(pace > 0 && !run.many() ? 1 / pace : 0);
    watch.go_on = [&, next = Clock::time_point()]() mutable {
      stopped = !call.go_on(next);
      next = std::max(next, Clock::now()) + std::chrono::ceil<Clock::duration>(apart);
      return !stopped;
    };
    const auto begun = std::chrono::steady_clock::now();
    struct Over {
      std::optional<Run>& run;
      ~Over() { run.reset(); }
    } over{run_};
    session.perform(action, watch);

    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    const int made = session.iterations() - run_->begun;
    Outcome outcome = session.outcome();
    if (outcome.status == Status::stopped && made != session.iterations()) {
      outcome.message += fmt::format(" This run made {} iteration{}.", made, made == 1 ? "" : "s");
    }
    result.member("status", name_of(outcome.status));
    result.member("message", outcome.message);
    result.member("iterations", made);
    const IterationRecord record = session.record();
    const spacetime::Measures measures{result, true};
    measures.member("objective", record.objective);
    measures.member("violation", record.violation);
    result.member("seconds", took.count());
    // A run that was stopped amounts to its iterations; one that ended by itself to what it was asked, less what had
    // been done before its last edit.  Many starts that were stopped are not logged: how far each had come is chance;
    // nor those that an edit ended, since nothing came of them.
    std::vector<PlacedAction> rest;
    if (!stopped && !(run_->many() && run_->edited)) {
      rest.push_back(placed(run_->rest));
      run_->since = session.iterations();
    }
    write_log(result, std::move(rest));
  }

  const protocol::Allowance& allowance_;
  std::unique_ptr<Session> session_;
  std::string fingerprint_;  // of the problem it has, once asked for
  std::optional<Run> run_;
  int runs_ = 0;
  std::shared_ptr<Shown> shown_ = std::make_shared<Shown>();
};

Turn turn_of_action(const Json& params) {
  if (!params.contains("action") || !params["action"].is_object() || !params["action"].contains("action")) {
    return Turn::between;
  }
  const Json& word = params["action"]["action"];
  return word == "solve" || word == "iterate" ? Turn::waits : Turn::between;
}

Turn between(const Json&) { return Turn::between; }
Turn ends(const Json&) { return Turn::ends; }

std::vector<protocol::Method> open(const protocol::Allowance& allowance) {
  const auto peer = std::make_shared<Peer>(allowance);
  return {
      {"problem/load", [peer](const Node& p, Writer& r, Call&) { peer->load(p, r); }, ends, true},
      {"problem/update", [peer](const Node& p, Writer& r, Call&) { peer->update(p, r); }, between, true},
      {"action/do", [peer](const Node& p, Writer& r, Call& call) { peer->act(p, r, call); }, turn_of_action},
      {"motion/get", [peer](const Node& p, Writer& r, Call&) { peer->get(p, r); }, between},
      {"motion/set", [peer](const Node& p, Writer& r, Call&) { peer->set(p, r); }, between},
      {"sample", [peer](const Node& p, Writer& r, Call&) { peer->sample(p, r); }, between},
  };
}

}  // namespace

protocol::Service service() {
  return {"spacetime-optimizer", SPACETIME_VERSION, protocol::optimizer_description(), open};
}

}  // namespace spacetime::optimizer
