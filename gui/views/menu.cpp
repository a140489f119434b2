#include "gui/views/menu.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gui/views/dialogs.h"
#include "gui/views/optimisation.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

namespace fs = std::filesystem;

void save(Ui& ui) {
  if (ui.state.file.empty())
    ui.memory.files.dialog = FilesMemory::Dialog::save;
  else
    ui.emit(Save{});
}

void run(Ui& ui) {
  // What the file still asks for comes first; after that, what the panel says.
  if (!ui.state.script.empty())
    ui.emit(RunScript{});
  else
    ui.act(solve_line(ui.memory), Notice::Place::optimisation);
}

bool can_run(const Ui& ui) { return ui.state.scene && ui.state.scene->problem && !ui.state.running; }

// Whether a ghost stands at the time shown.
bool is_pinned(const State& s) {
  return std::ranges::any_of(s.pins, [&](double pin) { return std::abs(pin - s.playback.time) < same_time; });
}

bool begin_menu(Ui& ui, const char* name) {
  if (ImGui::BeginMenu(name)) return true;
  ui.here(std::string("menu ") + name);
  return false;
}

void draw_file_menu(Ui& ui) {
  if (!begin_menu(ui, "File")) return;
  if (ImGui::MenuItem("New scene", "Ctrl+N")) leave_for(ui, {Leaving::To::fresh});
  ui.here("menu new");
  if (ImGui::MenuItem("Examples...", "Ctrl+E")) ui.memory.welcome = true;
  ui.here("menu examples");
  if (ImGui::MenuItem("Open...", "Ctrl+O")) ui.memory.files.dialog = FilesMemory::Dialog::open;
  if (ImGui::BeginMenu("Open recent", !ui.state.recent.empty())) {
    for (const std::string& file : ui.state.recent)
      if (ImGui::MenuItem(file.c_str())) leave_for(ui, {Leaving::To::file, file});
    ImGui::EndMenu();
  }
  if (!ui.state.left.empty() && begin_menu(ui, "Not saved when it ended")) {
    for (const LeftBehind& left : ui.state.left) {
      if (ImGui::MenuItem((name_of(left) + "##" + left.journal).c_str()))
        leave_for(ui, {Leaving::To::file, left.journal});
      ui.here("menu recover " + name_of(left));
    }
    ImGui::EndMenu();
  }
  ImGui::Separator();
  const bool there = ui.state.scene != nullptr;
  if (ImGui::MenuItem("Save", "Ctrl+S", false, there)) save(ui);
  ui.here("menu save");
  if (ImGui::MenuItem("Save as...", nullptr, false, there)) ui.memory.files.dialog = FilesMemory::Dialog::save;
  ImGui::Separator();
  if (ImGui::MenuItem("Make a film or pictures...", nullptr, false, ui.state.curves != nullptr && !ui.state.film))
    ui.memory.files.dialog = FilesMemory::Dialog::film;
  ui.here("menu film");
  ImGui::Separator();
  if (ImGui::MenuItem("Quit", "Ctrl+Q")) leave_for(ui, {});
  ImGui::EndMenu();
}

void draw_edit_menu(Ui& ui) {
  if (!begin_menu(ui, "Edit")) return;
  const State& s = ui.state;
  if (ImGui::MenuItem("Undo", "Ctrl+Z", false, can_undo(s))) ui.emit(Undo{});
  if (ImGui::MenuItem("Redo", "Ctrl+Y", false, can_redo(s))) ui.emit(Redo{});
  ImGui::Separator();
  if (ImGui::MenuItem("Key the pose", "K", false, s.pose.has_value())) ui.emit(KeyPose{});
  if (ImGui::MenuItem("Drop the pose", nullptr, false, s.pose.has_value())) ui.emit(SetPose{});
  if (ImGui::MenuItem("Copy the pose", "Ctrl+C", false, s.curves != nullptr)) ui.emit(CopyPose{});
  if (ImGui::MenuItem("Paste the pose", "Ctrl+V", false, s.copied.has_value())) ui.emit(PastePose{});
  if (ImGui::MenuItem("Paste it mirrored", "Ctrl+Shift+V", false, s.copied.has_value())) ui.emit(PastePose{true});
  ImGui::Separator();
  const bool there = s.curves != nullptr;
  if (ImGui::MenuItem("Smooth all", nullptr, false, there)) ui.act(filter_words(0.5).line);
  if (ImGui::MenuItem("Shake all", nullptr, false, there)) ui.act("shake amplitude 0.1");
  if (ImGui::MenuItem("Refine all", nullptr, false, there)) ui.act("refine");
  if (ImGui::MenuItem("Back to the declared start", nullptr, false, there)) ui.act(reset_words().line);
  ImGui::EndMenu();
}

void draw_view_menu(Ui& ui) {
  if (!begin_menu(ui, "View")) return;
  SceneMemory& m = ui.memory.scene;
  if (ImGui::MenuItem("Front", "1")) turn(ui, View::front);
  if (ImGui::MenuItem("Side", "2")) turn(ui, View::side);
  if (ImGui::MenuItem("Above", "3")) turn(ui, View::top);
  if (ImGui::MenuItem("Free", "4")) turn(ui, View::free);
  if (ImGui::MenuItem("Frame the figure", "F")) m.framed = false;
  ImGui::MenuItem("Orthographic", nullptr, &m.camera.orthographic);
  ImGui::Separator();
  if (ImGui::MenuItem("Pin a ghost here", "G", is_pinned(ui.state), ui.state.curves != nullptr))
    ui.emit(Pin{ui.state.playback.time, !is_pinned(ui.state)});
  ui.here("menu pin");
  ImGui::MenuItem("Ghosts along the motion", "Shift+G", &m.ghosts);
  ImGui::MenuItem("Trails", "T", &m.trails);
  ImGui::MenuItem("Forces", nullptr, &m.forces);
  ImGui::MenuItem("Marks of constraints", nullptr, &m.marks);
  ImGui::Separator();
  if (ImGui::MenuItem("Dark", nullptr, ui.state.dark)) ui.emit(SetTheme{!ui.state.dark});
  ui.here("menu dark");
  ImGui::EndMenu();
}

}  // namespace

void turn(Ui& ui, View view) {
  ui.memory.scene.camera = looking(view, ui.memory.scene.camera);
  ui.memory.scene.framed = false;
}

void draw_menu(Ui& ui) {
  if (!ImGui::BeginMenuBar()) return;
  draw_file_menu(ui);
  draw_edit_menu(ui);
  draw_view_menu(ui);
  if (begin_menu(ui, "Help")) {
    if (ImGui::MenuItem("Shortcuts", "F1")) ui.memory.shortcuts = true;
    ImGui::Separator();
    ImGui::TextDisabled("The language's manual: symbolic/LANGUAGE.md");
    ImGui::EndMenu();
  }
  const State& s = ui.state;
  std::string title = s.file.empty() ? "untitled" : std::string(fs::path(s.file).filename());
  if (unsaved(s)) title += " (not saved)";
  const float width = ImGui::CalcTextSize(title.c_str()).x;
  ImGui::SameLine(ImGui::GetWindowWidth() - width - ui.scaled(14));
  ImGui::TextDisabled("%s", title.c_str());
  ui.here("title");
  ImGui::EndMenuBar();
}

void draw_toolbar(Ui& ui) {
  const State& s = ui.state;
  const auto button = [&](const char* label, const char* name, bool possible, const char* help, bool strong = false) {
    if (!possible) ImGui::BeginDisabled();
    if (strong) {
      ImVec4 colour = ui.colours().accent;
      colour.w = 0.75F;
      ImGui::PushStyleColor(ImGuiCol_Button, colour);
    }
    const bool pressed = ImGui::Button(label, {ui.scaled(68), 0});
    if (strong) ImGui::PopStyleColor();
    if (!possible) ImGui::EndDisabled();
    ui.here(name);
    ui.help(help);
    ImGui::SameLine(0, ui.scaled(6));
    return pressed && possible;
  };
  const bool whole = s.running && !s.stopping && !can_pause(s);  // of many starts
  if (s.running) {
    const char* help = whole ? "Of many starts nothing is left before the end: it cannot be paused, only stopped."
                             : "Keep what is reached, to go on with it (F5).";
    if (button("Pause", "pause", can_pause(s), help, true)) ui.emit(Pause{});
  } else if (can_continue(s)) {
    const std::string help = "Go on where it was paused, as it was asked for (F5): " + s.paused->line;
    if (button("Continue", "continue", can_run(ui), help.c_str(), true)) ui.emit(Continue{});
  } else {
    const std::string help = s.script.empty() ? "Find the motion (F5): " + solve_line(ui.memory)
                                              : "Do what the file asks for (F5): " + s.script.front();
    if (button("Run", "run", can_run(ui), help.c_str(), can_run(ui))) run(ui);
  }
  const char* stopping =
      whole ? "End it (Esc). Of many starts nothing is left before the end."
            : "End it; what is reached is kept (Esc). It leaves the same line as a pause, but Run then begins "
              "with what the panel says.";
  if (button("Stop", "stop", (s.running && !s.stopping) || can_continue(s), stopping)) ui.emit(Stop{});
  if (button("Step", "step", can_run(ui), "One iteration (F10)"))
    ui.act(iterate_words(1).line, Notice::Place::optimisation);
  ImGui::SameLine(0, ui.scaled(18));
  if (button("Undo", "undo", can_undo(s), "Undo (Ctrl+Z)")) ui.emit(Undo{});
  if (button("Redo", "redo", can_redo(s), "Redo (Ctrl+Y)")) ui.emit(Redo{});
  ImGui::SameLine(0, ui.scaled(18));
  if (s.ghost) {
    if (button("Accept", "accept", true, "Keep this motion and put the ghost of the one before away"))
      ui.emit(DropGhost{});
    if (button("Go back", "go back", can_undo(s), "Return to the motion before the edit")) ui.emit(Undo{});
  }
  if (s.pose) {
    if (button("Key", "key pose", true, "Pull the motion through this pose (K)", true)) ui.emit(KeyPose{});
    if (button("Drop", "drop pose", true, "Forget this pose")) ui.emit(SetPose{});
  }
  ui.notices(Notice::Place::view);
  ImGui::NewLine();
}

void draw_status(Ui& ui) {
  const State& s = ui.state;
  const auto daemon = [&](const char* name, const Daemon& d) {
    const ImVec4& colour = d.condition == Daemon::Condition::ready  ? ui.colours().good
                           : d.condition == Daemon::Condition::lost ? ui.colours().bad
                                                                    : ui.colours().warning;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float size = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + size / 2, at.y + size / 2}, size * 0.28F, packed(colour));
    ImGui::Dummy({size, size});
    ImGui::SameLine(0, 2);
    ImGui::TextDisabled("%s", name);
    const std::string text = fmt::format("The {} is {}.{}{}", name,
                                         d.condition == Daemon::Condition::ready  ? "ready"
                                         : d.condition == Daemon::Condition::lost ? "lost"
                                                                                  : "being started",
                                         d.why.empty() ? "" : " ", d.why);
    ui.help(text.c_str());
    ImGui::SameLine(0, ui.scaled(14));
  };
  daemon("symbolic", s.symbolic);
  daemon("optimizer", s.optimizer);
  if (s.film) {
    ImGui::TextUnformatted(
        fmt::format("Making {}: {}", fs::path(s.film->first).filename().string(), s.film->second).c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("Stop##film")) ui.emit(DropFilm{});
    ui.here("stop film");
    ImGui::SameLine(0, ui.scaled(14));
  }
  bool told = false;
  for (std::size_t i = s.notices.size(); i-- > 0 && !told;) {
    const Notice& notice = s.notices[i];
    if (notice.place != Notice::Place::status) continue;
    told = true;
    ImGui::TextColored(ui.colour(notice.severity), "%s", notice.text.c_str());
    ui.here("notice");
    if (ImGui::IsItemClicked()) ui.emit(Dismiss{static_cast<int>(i)});
    ui.help((notice.text + "\nClick to put this away.").c_str());
  }
  if (told || !s.motion || (!s.running && s.motion->iterations == 0)) return;
  // The first sentence; the rest is in the panel, and in the help.
  const std::string& message = s.motion->message;
  ImGui::TextDisabled("%s", s.running ? "Solving" : message.substr(0, message.find(". ")).c_str());
  ui.help(s.motion->message.c_str());
}

void take_keys(Ui& ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const State& s = ui.state;
  const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
  if (!ImGui::IsAnyMouseDown()) ui.memory.drag_dropped = false;
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) return;
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
  if (pressed(GLFW_KEY_ESCAPE)) {
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
      ui.memory.scene.ghosts = !ui.memory.scene.ghosts;
    else if (s.curves)
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
