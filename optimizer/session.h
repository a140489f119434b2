// A problem that is worked on: its trajectories from one action to the next.  `run` makes one for a problem's own
// actions, a daemon one for each of its peers.
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "common/motion.h"
#include "common/problem.h"
#include "optimizer/bfgs.h"
#include "optimizer/edit.h"
#include "optimizer/numerics.h"
#include "optimizer/outcome.h"
#include "optimizer/sqp92.h"

namespace spacetime::optimizer {

// Who looks on while an action iterates.
struct Watch {
  int threads = 0;                                                // for many starts; as many as there are cores where 0
  std::function<void(const std::function<void()>& work)> around;  // called in each of those threads; see Crew
  std::function<void(const IterationRecord&)> progress;           // after each iteration
  bool checkpoint = false;  // there is to be a checkpoint at the end: a method that would have none is refused
  // Asked before each iteration; false ends the action, and the motion reached is kept.  It may perform edits on the
  // session (is_edit), which then take effect with the iteration that follows; a solve from many starts ends.
  std::function<bool()> go_on;
};

// Without a limit of its own a solve ends after so many iterations: ten times what the hardest examples take.
inline constexpr int default_iterations = 1000;

// Whether an action only changes the problem or the motion, so that it can be performed between two iterations.
bool is_edit(const Action& action);

class Session {
 public:
  // Starts from the keyframes, or from `start`, to which `reset` then returns.  Throws InputError where the problem
  // makes no sense with its constants' values.  Of statements declared behind actions those count that stand before
  // action number `declared` of the problem's list.
  explicit Session(Problem problem, std::optional<Motion> start = {}, int declared = 0);

  // Statements that take effect before action number `action` of the problem's list do so.
  void declare(int action);

  // Throws InputError for what cannot be done; all is then as it was before.
  void perform(const Action& action, const Watch& watch = {});

  // Another problem takes the place of this one, and what has been edited is edited in it; the motion goes on as far as
  // names agree, undisturbed where iterations do not depend on what differs.  Throws InputError, also where there would
  // be more unknowns than `most_unknowns` on the knots that refinements chose; all is then as it was before.
  void update(Problem problem, double most_unknowns = std::numeric_limits<double>::infinity());

  // The motion as it stands, with what the last `solve` or `iterate` came to.  One edited since is judged first, by the
  // tolerance, under the problem as it is now.
  Motion motion(double tolerance = Solve{}.tolerance);
  // What every instance of what holds costs; none where nobody knows.
  std::vector<Multipliers> multipliers() const;
  // Goes on from this motion.  With a checkpoint: where that was made, to the same bits, edits, window and damping
  // included, in a session of the same problem.  Without: as far as names agree, on its knots where they span the same
  // time, and from its number of iterations.  Throws InputError (CheckpointError); all is then as it was before.
  void set_motion(const Motion& motion);

  // What the next step depends on beside the motion; the caller adds which problem and which of its actions it is.
  // Throws InputError where it would be too long a document.
  Checkpoint checkpoint() const;
  // The motion as it stands, to come back to by set_motion: with a checkpoint, without measures.
  Motion moment() const;

  // Every plotted expression and body pose, or the wanted ones, at times (s) within the problem's span.
  Samples samples(std::span<const double> times, const std::set<std::string>* wanted = nullptr) const;

  // The present point.
  IterationRecord record() const;
  std::vector<Trajectory> trajectories() const;
  std::vector<std::pair<std::string, double>> parameters() const;
  int iterations() const { return state_.iterations; }

  // The problem as edited.
  const Problem& problem() const { return edited_.problem; }
  // As it was loaded.
  const Problem& original() const { return *original_; }

  // Says why nothing more is done.
  void stop(std::string message);
  const Outcome& outcome() const { return outcome_; }

 private:
  using Clock = std::chrono::steady_clock;

  void act(const Solve& solve, const Watch& watch);
  void act(const Iterate& iterate, const Watch& watch);
  void act(const Reset& reset, const Watch& watch);
  void act(const Control& control, const Watch& watch);
  void act(const Window& window, const Watch& watch);
  void act(const Damp& damp, const Watch& watch);
  void act(const Refine& refine, const Watch& watch);
  void act(const Shake& shake, const Watch& watch);
  void act(const Smooth& smooth, const Watch& watch);
  void act(const PullKeys& keys, const Watch& watch);
  template <class Edit>
  requires requires(Edited& edited, const Edit& edit) { apply(edited, edit); }
  void act(const Edit& edit, const Watch& watch);
  template <class Other>
  void act(const Other& other, const Watch& watch);

  // One step, or what it came to where there is none; `afresh` where the motion has been edited since the last.
  using Step = std::function<std::optional<Outcome>(bool afresh)>;
  void solve_from_many(int starts, int limit, double tolerance, const Watch& watch);
  void iterate(int limit, double tolerance, const Watch& watch, const Step& step);
  void iterate(int limit, double tolerance, const Watch& watch);  // by Newton
  template <class State, class Make>
  void iterate_by(const Make& make, int limit, double tolerance, const Watch& watch);
  // A point of a problem with all that is worked out there.
  struct Standing {
    std::shared_ptr<Numerics> numerics;
    std::vector<double> x;
    double objective_outside = 0;
    std::vector<double> terms_outside;
    NewtonState state;
  };
  // Whatever can fail, for want of memory too, fails in `stand`, while nothing has changed; the others change all.
  Standing stand(std::shared_ptr<Numerics> numerics, std::vector<double> x, const Carried* carried) const;
  void go_on_from(Standing standing) noexcept;
  void restart(std::vector<double> x, const Carried* carried = nullptr);
  void take_over(Edited edited, Setting setting, const Curves* curves = nullptr);
  Curves curves() const;
  template <class Change, class... Arguments>
  void change_curves(const Change& change, const Arguments&... arguments);  // by a function of reshape.h
  void reshape(const Curves& curves);
  void refine_where_needed(const Refine& action);
  void resume(const Motion& motion);
  void judge(double tolerance);
  void mend();  // after an exception
  bool reached(double tolerance) const;
  std::string nth_iteration() const;  // "iteration 12", the last
  std::string standing(double tolerance) const;
  bool foreign() const { return other_.index() != 0; }
  std::vector<double> unknowns() const;
  std::vector<double> unknowns(const Curves& curves) const;
  std::vector<Trajectory> trajectories(const std::vector<double>& x) const;
  Motion bare() const;  // its curves and parameters alone
  std::vector<std::pair<std::string, double>> constants() const;
  std::vector<double> settled() const;
  std::string standing_elsewhere(double tolerance) const;
  double elapsed() const;

  Clock::time_point begun_ = Clock::now();
  std::shared_ptr<const Problem> original_;
  Edited edited_;
  std::vector<Action> edits_;  // that led from one to the other
  std::optional<Motion> start_;
  int declared_ = 0;  // actions of the problem's list before which everything is declared
  Setting setting_;
  int shakes_ = 0;                     // without a seed of their own, so far
  std::shared_ptr<Numerics> now_;      // shared with the threads of many starts
  std::vector<double> x_;              // all unknowns; what is free is in state_
  double objective_outside_ = 0;       // the part of the objective that the window leaves as it is
  std::vector<double> terms_outside_;  // of its terms (terms_of); empty without a window
  NewtonState state_;
  int restarts_ = 0;  // how often something else than a step has put the motion where it is
  Outcome outcome_;
  std::vector<Minimum> minima_;  // of the last solve, where it had many starts
  bool judged_ = false;          // the outcome speaks of the present point
  bool torn_ = false;  // a step ended in an exception: x is whole, what is known there may be of another point
  // Of another method than Newton, where one has led to this point: what only Newton wants of state_ is then older.
  std::variant<std::monostate, Sqp92State, BfgsState> other_;
};

}  // namespace spacetime::optimizer
