#include "gui/views/acts.h"

#include <algorithm>
#include <cmath>

#include "gui/views/optimisation.h"

namespace spacetime::gui {

void save(Ui& ui) {
  if (ui.state.file.empty())
    ui.memory.files.dialog = FilesMemory::Dialog::save;
  else
    ui.emit(Save{});
}

void run(Ui& ui) {
  if (!ui.state.script.empty())
    ui.emit(RunScript{});
  else
    ui.act(solve_line(ui.memory), Notice::Place::optimisation);
}

bool can_run(const Ui& ui) { return ui.state.scene && ui.state.scene->problem && !ui.state.running; }

bool is_pinned(const State& s) {
  return std::ranges::any_of(s.pins, [&](double pin) { return std::abs(pin - s.playback.time) < same_time; });
}

void show_ghosts(Ui& ui, bool on) {
  ui.memory.scene.ghosts = on;
  ui.emit(Remark{!on                         ? "The ghosts along the motion are put away."
                 : !ui.state.curves          ? "Ghosts along the motion are shown once there is one."
                 : ui.state.playback.playing ? "Ghosts along the motion are shown when it does not play."
                                             : "Five ghosts along the motion are shown."});
}

void turn(Ui& ui, View view) {
  ui.memory.scene.camera = looking(view, ui.memory.scene.camera);
  ui.memory.scene.framed = false;
}

}  // namespace spacetime::gui
