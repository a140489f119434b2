// How it is looked at: playback, selection, poses, drafts, notices; and how the daemons are.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/bspline.h"
#include "gui/apply.h"
#include "gui/journal.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

using Place = Notice::Place;

constexpr std::size_t most_pins = 40;  // more ghosts tell nothing, and cost as many figures a frame

// The other side's name, for a pose that is to be mirrored: left for right, with either case.
std::string mirrored(std::string name) {
  static const std::pair<std::string_view, std::string_view> sides[] = {{"left", "right"}, {"Left", "Right"}};
  for (const auto& [left, right] : sides) {
    for (const auto& [from, to] : {std::pair(left, right), std::pair(right, left)}) {
      if (const auto at = name.find(from); at != std::string::npos) return name.replace(at, from.size(), to);
    }
  }
  return name;
}

}  // namespace

void apply(State& state, const DropGhost&, Effects&) { state.ghost = nullptr; }

void apply(State& state, const Play& event, Effects&) { state.playback.playing = event.on; }

void apply(State& state, const SetPlayback& event, Effects&) { state.playback = event.playback; }

void apply(State& state, const Select& event, Effects&) { state.selection = event.selection; }

void apply(State& state, const Pin& event, Effects& effects) {
  const auto there = [&](double time) { return std::abs(time - event.time) < same_time; };
  const bool was_there = std::erase_if(state.pins, there) > 0;
  const std::string when = fmt::format("{:.4g} s", event.time);
  if (!event.on) {
    if (was_there) remark(state, "The ghost at " + when + " is gone.");
  } else if (!state.curves) {
    remark(state, "There is no figure yet to pin a ghost of.");
  } else if (state.pins.size() >= most_pins) {
    remark(state, fmt::format("No ghost is pinned: there are {} already.", most_pins));
  } else {
    state.pins.insert(std::ranges::upper_bound(state.pins, event.time), event.time);
    remark(state, "A ghost is pinned at " + when + ": go to another time to see it beside the figure.");
  }
  if (state.present >= 0) effects.push_back(JournalLine{journal_pins(state)});
}

void apply(State& state, const ShowSpan& event, Effects&) { state.span = {event.from, event.to}; }

void apply(State& state, const SetPace& event, Effects&) { state.pace = event.pace; }

void apply(State& state, const Remark& event, Effects&) { remark(state, event.text); }

void apply(State& state, const SetPose& event, Effects&) { state.pose = event.pose; }

void apply(State& state, const CopyPose&, Effects&) {
  if (!state.curves) return;
  Pose pose;
  for (const Trajectory& dof : state.curves->dofs) {
    const auto& knots = dof.basis.knots;
    const double time = std::clamp(state.playback.time, knots.front(), knots.back());
    pose.values[dof.name] = value(dof.basis, dof.coefficients, time);
  }
  if (state.pose) {
    for (const auto& [name, value] : state.pose->values) pose.values[name] = value;
  }
  state.copied = std::move(pose);
}

void apply(State& state, const PastePose& event, Effects&) {
  if (!state.copied) return;
  state.pose = state.copied;
  if (!event.mirrored) return;
  for (const auto& [name, value] : state.copied->values) {
    const std::string other = mirrored(name);
    if (other != name && state.copied->values.contains(other)) state.pose->values[other] = value;
  }
}

void apply(State& state, const KeyPose&, Effects& effects) {
  if (!state.pose || state.pose->values.empty()) return;
  std::vector<std::pair<std::string, double>> keys(state.pose->values.begin(), state.pose->values.end());
  const std::string line = key_words(state.playback.time, keys).line;
  state.pose.reset();
  notify(state, {.place = Place::view,
                 .text = "Keyed as a starting guess: Run may move it. To hold the pose, add a constraint.",
                 .until = state.clock + remark_seconds});
  apply(state, Act{line, Place::timeline}, effects);
}

void apply(State& state, const Draft& event, Effects&) {
  if (event.text) {
    state.drafts[event.about] = *event.text;
  } else {
    state.drafts.erase(event.about);
  }
}

void apply(State& state, const SetTheme& event, Effects& effects) {
  state.dark = event.dark;
  effects.push_back(KeepSettings{state.dark, state.recent});
}

void apply(State& state, const Dismiss& event, Effects&) {
  if (event.index < 0 || event.index >= static_cast<int>(state.notices.size())) return;
  state.notices.erase(state.notices.begin() + event.index);
}

void apply(State& state, const Tick& event, Effects&) {
  state.clock += event.seconds;
  std::erase_if(state.notices, [&](const Notice& notice) { return notice.until > 0 && notice.until <= state.clock; });
  Playback& playback = state.playback;
  if (!playback.playing || !state.scene || !state.scene->problem) return;
  const double start = state.scene->problem->start, end = state.scene->problem->end;
  playback.time += playback.speed * event.seconds;
  if (playback.time < end && playback.time >= start) return;
  if (playback.loop) {
    const double turns = (playback.time - start) / (end - start);
    playback.time = start + (turns - std::floor(turns)) * (end - start);
  } else {
    playback.time = std::clamp(playback.time, start, end);
    playback.playing = false;
  }
}

void apply(State& state, const DaemonIs& event, Effects&) {
  Daemon& daemon = event.symbolic ? state.symbolic : state.optimizer;
  const std::string name = event.symbolic ? "The symbolic daemon" : "The optimizer";
  using Condition = Daemon::Condition;
  if (event.condition == Condition::ready && daemon.condition != Condition::ready && daemon.met) {
    ++daemon.restarts;
    remark(state, name + " ended and was started again; nothing is lost.");
  }
  if (event.condition == Condition::lost) {
    notify(state, {.severity = Severity::error,
                   .text = name + " is lost: " + event.why +
                           ". The motions of the log can be looked at and the scene can be "
                           "saved; to go on, save it, start the window again and open it.",
                   .lasting = true});
  }
  daemon.met = daemon.met || event.condition == Condition::ready;
  daemon.condition = event.condition;
  daemon.why = event.why;
}

}  // namespace spacetime::gui
