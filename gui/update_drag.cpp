// Dragging a constant, a key, a slider or a control point.  While it lasts the newest value is sent as soon as the one
// before has been followed by a few iterations (of a control point, as soon as the motion with it is known).  When it
// is let go all of that is undone from a checkpoint; then the last value is set and solved for like any other act, so
// that the text leads to the same bits as the session.
#include <algorithm>

#include "gui/apply.h"

namespace spacetime::gui {
namespace {

using Kind = Wanted::Kind;

// Iterations that follow each value of a drag: enough to come near, few enough to follow the hand.
constexpr int steering_iterations = 8;

}  // namespace

void apply(State& state, const Steer& event, Effects& effects) {
  if (!ready(state)) return;
  Work& work = state.work;
  work.scripting = false;
  state.steering = event.steering;
  if (!work.drag) work.drag.emplace();
  work.drag->line = event.steering.line;
  work.drag->actions = event.steering.actions;
  work.drag->solves = event.steering.solves;
  work.drag->afresh = event.steering.afresh;
  work.drag->fresh = true;
  if (work.drag->run && work.drag->moved) {
    effects.push_back(Cancel{work.drag->run});
    work.drag->moved = false;
  }
}

void advance_drag(State& state, Effects& effects) {
  Work& work = state.work;
  Work::Drag& drag = *work.drag;
  if (!drag.begun) {
    if (work.run) return stop_run(state, effects);
    if (!state.log[state.present].checkpoint) return;
    keep_ghost(state, state.curves);
  }
  if (!drag.fresh || drag.unanswered > 0) {
    // Iterations for a value that is no more are not waited for.
    if (!drag.fresh || !drag.run || !drag.moved) return;
    effects.push_back(Cancel{drag.run});
    drag.moved = false;
    return;
  }
  drag.begun = true;
  drag.fresh = drag.moved = false;
  drag.unanswered = static_cast<int>(drag.actions.size()) + 1;
  if (drag.afresh) {
    Request request;
    request.method = "motion/set";
    request.params = "\"motion\":" + *state.log[state.present].checkpoint;
    ask(state, effects, std::move(request), {Kind::steer});
    ++drag.unanswered;
  }
  for (const std::string& action : drag.actions) ask_action(state, effects, action, {Kind::steer});
  if (drag.solves) {
    drag.run =
        ask_action(state, effects, "{\"action\":\"solve\",\"iterations\":" + std::to_string(steering_iterations) + "}",
                   {Kind::steer_run});
    ++drag.unanswered;
  }
  ask_motion(state, effects, {Kind::steer});
}

void leave_drag(State& state, Effects& effects) {
  Work& work = state.work;
  if (work.drag->begun) {
    if (work.drag->run) effects.push_back(Cancel{work.drag->run});
    forget(state, Kind::steer);
    forget(state, Kind::steer_run);
    work.at = 0;
  }
  work.drag.reset();
  state.steering.reset();
}

void apply(State& state, const Steered& event, Effects& effects) {
  Work& work = state.work;
  if (!work.drag) return;
  const std::string line = work.drag->line;
  const bool begun = work.drag->begun, solves = work.drag->solves;
  leave_drag(state, effects);
  if (event.keep) {
    if (!push_task(state, {.line = line, .place = Notice::Place::view}) || !solves) return;
    push_task(state, {.line = "solve", .place = Notice::Place::view, .merge = true, .iterates = true});
  } else if (begun) {
    show(state, state.log[state.present]);
  }
}

}  // namespace spacetime::gui
