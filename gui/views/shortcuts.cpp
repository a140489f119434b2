#include "gui/views/shortcuts.h"

#include <GLFW/glfw3.h>
#include <imgui_internal.h>

#include <algorithm>

#include "gui/views/acts.h"
#include "gui/views/dialogs.h"
#include "gui/words.h"

namespace spacetime::gui {

void take_keys(Ui& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const State& s = ui.state;
  if (!ImGui::IsAnyMouseDown()) ui.memory.drag_dropped = false;
  if (ImGui::GetTopMostPopupModal()) return;
  // A menu gives way to whatever a key asks for.
  const bool in_menu = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  const auto pressed = [in_menu](int key) {
    const bool is = ImGui::IsKeyPressed(key, false);
    if (is && in_menu) ImGui::ClosePopupToLevel(0, true);
    return is;
  };
  if (pressed(GLFW_KEY_F1)) ui.memory.shortcuts = true;
  if (pressed(GLFW_KEY_F5)) {
    if (s.running)
      ui.emit(Pause{});
    else if (can_continue(s))
      ui.emit(Continue{});
    else if (can_run(ui))
      run(ui);
  }
  if (pressed(GLFW_KEY_F10) && can_run(ui)) ui.act(iterate_words(1).line, Notice::Place::optimisation);
  if (io.KeyCtrl) {
    if (pressed(GLFW_KEY_N)) leave_for(ui, {Leaving::To::fresh});
    if (pressed(GLFW_KEY_O)) ui.memory.files.dialog = FilesMemory::Dialog::open;
    if (pressed(GLFW_KEY_E)) ui.memory.welcome = true;
    if (pressed(GLFW_KEY_S) && s.scene) save(ui);
    if (pressed(GLFW_KEY_Q)) leave_for(ui, {});
    if (io.WantTextInput) return;
    if (pressed(GLFW_KEY_Z)) ui.emit(io.KeyShift ? Event(Redo{}) : Event(Undo{}));
    if (pressed(GLFW_KEY_Y)) ui.emit(Redo{});
    if (pressed(GLFW_KEY_C) && s.curves) ui.emit(CopyPose{});
    if (pressed(GLFW_KEY_V) && s.copied) ui.emit(PastePose{io.KeyShift});
    return;
  }
  if (io.WantTextInput) return;
  if (pressed(GLFW_KEY_ESCAPE) && !in_menu) {
    if (s.steering) {
      ui.emit(Steered{false});
      ui.memory.drag_dropped = true;
    } else if (s.pose)
      ui.emit(SetPose{});
    else if (s.running)
      ui.emit(Stop{});
  }
  if (pressed(GLFW_KEY_SPACE)) ui.emit(Play{!s.playback.playing});
  if (pressed(GLFW_KEY_K) && s.pose) ui.emit(KeyPose{});
  if (pressed(GLFW_KEY_G)) {
    if (io.KeyShift)
      show_ghosts(ui, !ui.memory.scene.ghosts);
    else
      ui.emit(Pin{s.playback.time, !is_pinned(s)});
  }
  if (pressed(GLFW_KEY_T)) ui.memory.scene.trails = !ui.memory.scene.trails;
  if (pressed(GLFW_KEY_F)) ui.memory.scene.framed = false;
  if (pressed(GLFW_KEY_1)) turn(ui, View::front);
  if (pressed(GLFW_KEY_2)) turn(ui, View::side);
  if (pressed(GLFW_KEY_3)) turn(ui, View::top);
  if (pressed(GLFW_KEY_4)) turn(ui, View::free);
  if (!s.scene || !s.scene->problem) return;
  const auto& problem = *s.scene->problem;
  Playback p = s.playback;
  const auto jump = [&](double time) {
    p.time = std::clamp(time, problem.start, problem.end);
    p.playing = false;
    ui.emit(SetPlayback{p});
  };
  if (ImGui::IsKeyPressed(GLFW_KEY_LEFT)) jump(p.time - 1 / p.rate);
  if (ImGui::IsKeyPressed(GLFW_KEY_RIGHT)) jump(p.time + 1 / p.rate);
  if (pressed(GLFW_KEY_HOME)) jump(problem.start);
  if (pressed(GLFW_KEY_END)) jump(problem.end);
}

}  // namespace spacetime::gui
