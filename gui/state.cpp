#include "gui/state.h"

#include <algorithm>

namespace spacetime::gui {

std::string text_of(const State& state) { return state.scene ? state.scene->text : std::string(); }

std::string text_to_save(const State& state) {
  std::string text = text_of(state);
  for (const std::string& line : state.script) text += line;
  return text;
}

bool unsaved(const State& state) { return state.scene && text_to_save(state) != state.saved; }

bool is_typing(const State& state) {
  return std::ranges::any_of(state.drafts, [](const auto& draft) { return !draft.second.empty(); });
}

bool under_way(const State& state) { return state.running || state.waiting > 0 || state.steering || is_typing(state); }

bool would_lose(const State& state) { return unsaved(state) || under_way(state); }

// What waits is dropped first; where a run goes on, undoing is leaving it.
bool can_undo(const State& state) {
  if (state.present < 0) return false;
  if (state.waiting > 0) return true;
  if (state.running && state.log[state.present].checkpoint) return true;
  for (int i = state.present - 1; i >= 0; --i) {
    if (state.log[i].checkpoint) return true;
  }
  return false;
}

bool can_redo(const State& state) {
  for (int i = state.present + 1; i < static_cast<int>(state.log.size()); ++i) {
    if (state.log[i].checkpoint) return true;
  }
  return false;
}

bool can_pause(const State& state) { return state.running && !state.stopping && !state.work.whole; }

bool can_continue(const State& state) {
  return state.paused && !state.running && state.present >= 0 && state.log[state.present].number == state.paused->entry;
}

std::optional<int> entry_of_ghost(const State& state) {
  for (int i = 0; state.ghost && i < state.present; ++i) {
    const Entry& entry = state.log[i];
    if (entry.number == state.ghost_entry && entry.checkpoint) return i;
  }
  return std::nullopt;
}

}  // namespace spacetime::gui
