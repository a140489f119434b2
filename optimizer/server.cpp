#include "optimizer/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

#include "common/assert.h"
#include "common/diagnostic.h"
#include "optimizer/refine.h"
#include "optimizer/session.h"
#include "protocol/action_json.h"
#include "protocol/check.h"
#include "protocol/declared.h"
#include "protocol/memory.h"
#include "protocol/motion_json.h"
#include "protocol/openrpc.h"
#include "protocol/problem_json.h"
#include "protocol/program_json.h"

namespace spacetime::optimizer {
namespace {

using protocol::Call;
using protocol::Code;
using protocol::Error;
using protocol::Turn;

void write_measure(Writer& to, std::string_view name, double value) {
  to.key(name);
  if (std::isfinite(value)) {
    to.number(value);
  } else {
    to.null();
  }
}

// What one peer has been shown of a run, so that only changes are sent.  Used by whoever writes its messages.
struct Shown {
  int run = 0;
  std::vector<Trajectory> dofs;
};

// The iterations of a run that no message has told of yet: iterates may be left out, what was measured at them is not.
class Untold {
 public:
  void add(const IterationRecord& record) {
    const std::lock_guard lock(mutex_);
    if (records_.size() == most) {  // nobody reads: every second one says as much
      for (std::size_t i = 0; i < most / 2; ++i) records_[i] = std::move(records_[2 * i]);
      records_.resize(most / 2);
    }
    records_.push_back(record);
  }
  std::vector<IterationRecord> take_up_to(int iteration) {
    const std::lock_guard lock(mutex_);
    const auto later = [&](const IterationRecord& record) { return record.iteration > iteration; };
    const auto end = std::ranges::find_if(records_, later);
    std::vector<IterationRecord> told(std::make_move_iterator(records_.begin()), std::make_move_iterator(end));
    records_.erase(records_.begin(), end);
    return told;
  }

 private:
  static constexpr std::size_t most = 1024;
  std::mutex mutex_;
  std::vector<IterationRecord> records_;
};

// An iterate, copied to be written later, or never.
struct Snapshot {
  int run = 0;
  IterationRecord record;
  std::shared_ptr<Untold> untold;
  std::vector<Trajectory> dofs;
  std::vector<std::pair<std::string, double>> parameters;

  std::string text(Shown& shown) const {
    Writer to(false);
    to.object([&] {
      to.member("kind", "iteration");
      to.member("iteration", record.iteration);
      write_measure(to, "objective", record.objective);
      write_measure(to, "violation", record.violation);
      write_measure(to, "stationarity", record.stationarity);
      write_measure(to, "step", record.step);
      write_measure(to, "shift", record.shift);
      to.member("seconds", record.seconds);
      to.key("record");
      to.list_of(untold->take_up_to(record.iteration), [&](const IterationRecord& one) { write(to, one, true); });
      to.key("dofs");
      const bool same = shown.run == run && shown.dofs.size() == dofs.size();
      to.list([&] {
        for (std::size_t i = 0; i < dofs.size(); ++i) {
          const Trajectory* before = same ? &shown.dofs[i] : nullptr;
          if (before && *before == dofs[i]) continue;
          to.object([&] {
            to.member("name", dofs[i].name);
            if (!before || before->basis != dofs[i].basis) {
              to.key("basis");
              write(to, dofs[i].basis);
            }
            to.key("coefficients");
            to.numbers(dofs[i].coefficients);
          });
        }
      });
      if (parameters.empty()) return;
      to.key("parameters");
      to.object([&] {
        for (const auto& [name, value] : parameters) to.member(name, value);
      });
    });
    shown = {run, dofs};
    return to.take();
  }
};

// A solve or iterate that goes on.
struct Run {
  Solve rest;     // what is left of it, an `iterate` being a solve with that many iterations
  int since = 0;  // the iteration at which its last edit, or itself, began
  int begun = 0;  // ... itself, as the motion counts now
  bool edited = false;

  bool many() const { return rest.starts > 1; }  // its starts go on at their own pace
};

// A degree of freedom or its derivative, by the name that the language has for it: x, x' or x''.
struct Derivative {
  std::string name;
  std::size_t place;  // among the problem's
  int order;
};

Derivative derivative_named(const Node& name, const Problem& problem) {
  std::string_view bare = name.string();
  int order = 0;
  for (; order < 2 && bare.ends_with('\''); ++order) bare.remove_suffix(1);
  const auto found = std::ranges::find(problem.dofs, bare, &Dof::name);
  if (found == problem.dofs.end()) {
    auto names = names_of(problem.plots);
    for (const Body& body : problem.bodies) names.push_back(body.name);
    for (const Dof& dof : problem.dofs) names.push_back(dof.name);
    name.refuse(there_is_no("plotted expression, body or degree of freedom", name.string(), names));
  }
  return {name.string(), static_cast<std::size_t>(found - problem.dofs.begin()), order};
}

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
    Problem problem = checked_problem(params["problem"]);
    const double unknowns = count(problem);
    session_ = std::make_unique<Session>(std::move(problem));
    session_->declare(std::numeric_limits<int>::max());
    result.member("unknowns", static_cast<int>(unknowns));
  }

  void update(const Node& params, Writer& result) {
    params.object({"problem"}, {"revision"});
    Session& session = present();
    Problem problem = checked_problem(params["problem"]);
    session.update(std::move(problem));
    write_edit(result, {});
  }

  void act(const Node& params, Writer& result, Call& call) {
    params.object({"action"}, {"revision", "progress"});
    Session& session = present();
    const Node node = params["action"];
    const PlacedAction asked = action_from(node);
    if (const auto fault = validate(asked.action, session.problem())) {
      throw DocumentError("params", "/action" + fault->path, fault->message);
    }
    if (const auto* refine = std::get_if<Refine>(&asked.action)) require_room(most_of(*refine));
    const bool edit = is_edit(asked.action);
    SPACETIME_ASSERT(edit || !run_);
    try {
      edit ? session.perform(asked.action) : run(asked.action, result, call);
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
      motion.checkpoint->problem = fingerprint(session.original());
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

  void sample(const Node& params, Writer& result) {
    params.object({"times"}, {"expressions", "revision"});
    Session& session = present();
    const auto times = params["times"].numbers();
    const Problem& problem = session.problem();
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (times[i] < problem.start || times[i] > problem.end) {
        params["times"][i].refuse(fmt::format("{:.9g} is outside the problem's time, {:.9g} to {:.9g}", times[i],
                                              problem.start, problem.end));
      }
    }
    std::size_t each = 0;
    for (const Plot& plot : problem.plots) each += plot.outputs.size();
    each += 12 * problem.bodies.size();
    std::optional<std::vector<std::string>> wanted;
    std::vector<Derivative> dofs;
    if (const auto names = params.find("expressions")) {
      wanted = names->each([&](const Node& name) {
        const auto is_it = [&](const auto& thing) { return thing.name == name.string(); };
        if (std::ranges::none_of(problem.plots, is_it) && std::ranges::none_of(problem.bodies, is_it)) {
          dofs.push_back(derivative_named(name, problem));
        }
        return name.string();
      });
    }
    const double numbers = static_cast<double>(times.size()) * static_cast<double>(each + dofs.size());
    if (numbers > allowance_.samples) throw beyond("samples", allowance_, numbers);
    Samples samples = session.samples(times);
    const auto curves = session.trajectories();
    for (const Derivative& dof : dofs) {
      std::vector<std::vector<double>> rows;
      const Trajectory& curve = curves[dof.place];
      for (const double t : times) rows.push_back({value(curve.basis, curve.coefficients, t, dof.order)});
      samples.values.insert_or_assign(dof.name, std::move(rows));
    }
    const auto write_rows = [&](std::string_view member, const auto& tables) {
      result.key(member);
      result.object([&] {
        for (const auto& [name, rows] : tables) {
          if (wanted && std::ranges::find(*wanted, name) == wanted->end()) continue;
          result.key(name);
          result.list_of(rows, [&](const std::vector<double>& row) {
            result.list_of(row, [&](double value) { std::isfinite(value) ? result.number(value) : result.null(); });
          });
        }
      });
    };
    result.key("times");
    result.numbers(times);
    write_rows("values", samples.values);
    write_rows("poses", samples.poses);
  }

 private:
  Session& present() const {
    if (!session_) throw Error(Code::no_problem, "there is no problem yet: send \"problem/load\" first");
    return *session_;
  }

  Problem checked_problem(const Node& node) const {
    Problem problem = problem_from(node);
    double operations = 0;
    for (const auto& [name, program] : problem.programs) operations += static_cast<double>(program.op.size());
    if (operations > allowance_.operations) throw beyond("operations", allowance_, operations);
    if (const double unknowns = count(problem); unknowns > allowance_.unknowns) {
      throw beyond("unknowns", allowance_, unknowns);
    }
    if (const auto fault = validate(problem)) {
      throw DocumentError("params", "/problem" + fault->path, fault->message);
    }
    return problem;
  }

  // What a refinement would make is held to what a problem may be, before anything is made.
  void require_room(const Refine& action) const {
    const Problem& problem = session_->problem();
    const Constants constants = evaluate_constants(problem);
    const double unknowns =
        refined_coefficients(problem, constants, action) + static_cast<double>(problem.parameters.size());
    if (unknowns > allowance_.unknowns) throw beyond("unknowns", allowance_, unknowns);
    Problem finer = problem;
    Curves flat;
    for (const Dof& dof : problem.dofs) flat.emplace_back(dof.basis.size());
    refine(finer, constants, action, flat);
    if (const auto fault = validate(finer); fault && !validate(problem)) {
      throw Error(Code::refused, "the problem would be too large, refine less: " + fault->message);
    }
  }

  static double count(const Problem& problem) {
    double unknowns = static_cast<double>(problem.parameters.size());
    for (const Dof& dof : problem.dofs) unknowns += dof.basis.size();
    return unknowns;
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

  void run(const Action& action, Writer& result, Call& call) {
    Session& session = *session_;
    const int number = ++runs_;
    bool stopped = false;
    const auto show = [&, untold = std::make_shared<Untold>()](const IterationRecord& record) {
      untold->add(record);
      call.progress([iterate = Snapshot{number, record, untold, session.trajectories(), session.parameters()},
                     shown = shown_] { return iterate.text(*shown); });
    };
    Watch watch;
    watch.progress = show;
    watch.around = [account = protocol::account_of_thread()](const auto& work) {
      const protocol::Sharing sharing(account);
      work();
    };
    watch.go_on = [&] {
      stopped = !call.go_on();
      return !stopped;
    };
    Run run;
    if (const auto* solve = std::get_if<Solve>(&action)) run.rest = *solve;
    if (const auto* iterate = std::get_if<Iterate>(&action)) run.rest.iterations = iterate->iterations;
    run.since = run.begun = session.iterations();
    run_ = run;
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
    write_measure(result, "objective", record.objective);
    write_measure(result, "violation", record.violation);
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
