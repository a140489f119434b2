#include "gui/views/menu.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
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

// Where nothing changes in the picture it is said why.
void show_ghosts(Ui& ui, bool on) {
  ui.memory.scene.ghosts = on;
  ui.emit(Remark{!on                         ? "The ghosts along the motion are put away."
                 : !ui.state.curves          ? "Ghosts along the motion are shown once there is one."
                 : ui.state.playback.playing ? "Ghosts along the motion are shown when it does not play."
                                             : "Five ghosts along the motion are shown."});
}

// What was done since an entry of the log, in a line or two.
std::string acts_behind(const State& s, std::optional<int> entry) {
  constexpr std::size_t most = 160;
  std::string text;
  for (int i = entry.value_or(s.present) + 1; i <= s.present; ++i)
    text += (text.empty() ? "" : "; ") + in_one_line(s.log[static_cast<std::size_t>(i)].text);
  if (text.empty()) return "what is being done";
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

bool begin_menu(Ui& ui, const char* name, const char* help, bool enabled = true) {
  if (ImGui::BeginMenu(name, enabled)) return true;
  ui.control(std::string("menu ") + name, help);
  return false;
}

struct Item {
  const char* label;
  const char* keys = nullptr;
  bool possible = true, chosen = false;
};

// An entry of a menu; whether it was chosen.
bool entry(Ui& ui, const Item& item, const std::string& help) {
  const bool chosen = ImGui::MenuItem(item.label, item.keys, item.chosen, item.possible);
  const std::string label = item.label;
  ui.control("menu " + label.substr(0, label.find("##")), help);
  return chosen;
}

void draw_file_menu(Ui& ui) {
  if (!begin_menu(ui, "File", "Scenes: begin, open, save; films.")) return;
  using Dialog = FilesMemory::Dialog;
  Dialog& dialog = ui.memory.files.dialog;
  const State& s = ui.state;
  if (entry(ui, {"New scene", "Ctrl+N"}, "Begin with a scene of a few lines that can be run and changed."))
    leave_for(ui, {Leaving::To::fresh});
  if (entry(ui, {"Examples...", "Ctrl+E"}, "Scenes that come with the program, to try and to change."))
    ui.memory.welcome = true;
  if (entry(ui, {"Open...", "Ctrl+O"}, "A scene from a file.")) dialog = Dialog::open;
  if (begin_menu(ui, "Open recent", "Files that were opened or saved lately.", !s.recent.empty())) {
    for (const std::string& file : s.recent)
      if (entry(ui, {file.c_str()}, "Open it.")) leave_for(ui, {Leaving::To::file, file});
    ImGui::EndMenu();
  }
  if (!s.left.empty() && begin_menu(ui, "Not saved when it ended", "Sessions that a crash or a power cut ended.")) {
    for (const LeftBehind& left : s.left)
      if (entry(ui, {(name_of(left) + "##" + left.journal).c_str()},
                "Everything that was done in it comes back, undo included."))
        leave_for(ui, {Leaving::To::file, left.journal});
    ImGui::EndMenu();
  }
  ImGui::Separator();
  const bool there = s.scene != nullptr;
  if (entry(ui, {"Save", "Ctrl+S", there},
            "Write the scene with all that was done: solved again, it gives this motion."))
    save(ui);
  if (entry(ui, {"Save as...", nullptr, there}, "Write it under another name.")) dialog = Dialog::save;
  ImGui::Separator();
  if (entry(ui, {"Make a film or pictures...", nullptr, s.curves != nullptr && !s.film && !s.running && !s.steering},
            "Of the motion shown, into files, while the window goes on; not while a run or a drag changes it."))
    dialog = Dialog::film;
  ImGui::Separator();
  if (entry(ui, {"Quit", "Ctrl+Q"}, "Close the window; asks about what is not saved.")) leave_for(ui, {});
  ImGui::EndMenu();
}

void draw_edit_menu(Ui& ui) {
  if (!begin_menu(ui, "Edit", "Undo, poses, and acts on the whole motion.")) return;
  const State& s = ui.state;
  if (entry(ui, {"Undo", "Ctrl+Z", can_undo(s)}, "Back before the last act, at once.")) ui.emit(Undo{});
  if (entry(ui, {"Redo", "Ctrl+Y", can_redo(s)}, "What was undone, without solving again.")) ui.emit(Redo{});
  ImGui::Separator();
  const bool posed = s.pose.has_value(), there = s.curves != nullptr;
  if (entry(ui, {"Key the pose", "K", posed},
            "Pull the motion through the pose that was made, at the time shown: a starting guess, which Run may move."))
    ui.emit(KeyPose{});
  if (entry(ui, {"Drop the pose", "Esc", posed}, "Forget the pose that was made.")) ui.emit(SetPose{});
  if (entry(ui, {"Copy the pose", "Ctrl+C", there}, "Remember the figure as it stands.")) ui.emit(CopyPose{});
  if (entry(ui, {"Paste the pose", "Ctrl+V", s.copied.has_value()}, "Pose the figure as it was copied; K keys it."))
    ui.emit(PastePose{});
  if (entry(ui, {"Paste it mirrored", "Ctrl+Shift+V", s.copied.has_value()},
            "Likewise, with what is named left and right exchanged."))
    ui.emit(PastePose{true});
  ImGui::Separator();
  if (entry(ui, {"Smooth all", nullptr, there}, "Smooth what is free; run again afterwards."))
    ui.act(filter_words(0.5).line);
  if (entry(ui, {"Shake all", nullptr, there}, "Disturb what is free, to find another motion."))
    ui.act("shake amplitude 0.1");
  if (entry(ui, {"Refine all", nullptr, there}, "Halve the knot spans: the motion stays, and can become finer."))
    ui.act("refine");
  if (entry(ui, {"Back to the declared start", nullptr, there}, "Begin again from the sketch of the scene."))
    ui.act(reset_words().line);
  ImGui::EndMenu();
}

void draw_view_menu(Ui& ui) {
  if (!begin_menu(ui, "View", "From where the figure is seen, and what is shown with it.")) return;
  SceneMemory& m = ui.memory.scene;
  const State& s = ui.state;
  if (entry(ui, {"Front", "1"}, "Look along the z axis.")) turn(ui, View::front);
  if (entry(ui, {"Side", "2"}, "Look along the x axis.")) turn(ui, View::side);
  if (entry(ui, {"Above", "3"}, "Look down.")) turn(ui, View::top);
  if (entry(ui, {"Free", "4"}, "Look from the front, the right and above.")) turn(ui, View::free);
  if (entry(ui, {"Frame the figure", "F"}, "Bring all of the motion into view.")) m.framed = false;
  const auto toggle = [&](const char* label, const char* keys, bool& on, const char* help) {
    if (entry(ui, {label, keys, true, on}, help)) on = !on;
  };
  toggle("Orthographic", nullptr, m.camera.orthographic, "What is far looks as large as what is near.");
  ImGui::Separator();
  if (entry(ui, {"Pin a ghost here", "G", s.curves != nullptr, is_pinned(s)},
            "Show the pose at this time, pale, whatever the time; its mark in the ruler takes it away."))
    ui.emit(Pin{s.playback.time, !is_pinned(s)});
  if (entry(ui, {"Ghosts along the motion", "Shift+G", true, m.ghosts}, "Five poses from the start to the end, pale."))
    show_ghosts(ui, !m.ghosts);
  toggle("Trails", "T", m.trails, "The ways of hands, and of the points chosen in the tab Freedom.");
  toggle("Forces", nullptr, m.forces, "Torques and forces of the joints, as arrows.");
  toggle("Marks of constraints", nullptr, m.marks, "Where constraints hold and where they do not.");
  toggle("Legend", nullptr, m.legend, "A line under the figure that tells lines, marks and ghosts apart.");
  ImGui::Separator();
  if (entry(ui, {"Dark", nullptr, true, s.dark}, "Dark or light.")) ui.emit(SetTheme{!s.dark});
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
  if (begin_menu(ui, "Help", "Keys and the language.")) {
    if (entry(ui, {"Shortcuts", "F1"}, "The list of keys.")) ui.memory.shortcuts = true;
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

// How fast runs go, so that they can be watched.
void draw_pace(Ui& ui) {
  static constexpr std::array<std::pair<double, const char*>, 4> paces{
      {{0, "Full speed"}, {30, "30 a second"}, {8, "8 a second"}, {2, "2 a second"}}};
  const auto now = std::ranges::find(paces, ui.state.pace, [](const auto& pace) { return pace.first; });
  ImGui::SetNextItemWidth(ui.scaled(112));
  const bool open = ImGui::BeginCombo("##pace", now == paces.end() ? "" : now->second);
  if (!open)
    ui.control("pace",
               "How many iterations a second Run and Continue make at most: slowly enough the motion can be watched as "
               "it is found, and paused. What is found is the same. Takes effect with the next Run or Continue.");
  if (open) {
    for (const auto& [pace, name] : paces) {
      if (ImGui::Selectable(name, pace == ui.state.pace)) ui.emit(SetPace{pace});
      ui.control(std::string("pace ") + name, "At most so many iterations a second.");
    }
    ImGui::EndCombo();
  }
  ImGui::SameLine(0, ui.scaled(6));
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
    ui.control(name, help);
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
  draw_pace(ui);
  ImGui::SameLine(0, ui.scaled(18));
  if (button("Undo", "undo", can_undo(s), "Undo (Ctrl+Z)")) ui.emit(Undo{});
  if (button("Redo", "redo", can_redo(s), "Redo (Ctrl+Y)")) ui.emit(Redo{});
  ImGui::SameLine(0, ui.scaled(18));
  if (s.ghost) {
    if (button("Keep", "keep", true,
               "Keep the new motion: the pale one, which was before it, is put away. Nothing else changes, and Undo "
               "still leads back."))
      ui.emit(DropGhost{});
    const auto back = entry_of_ghost(s);
    const std::string help =
        "Back to the pale motion, which was before: " + acts_behind(s, back) + ". Redo brings the new one again.";
    if (button("Go back", "go back", back.has_value(), help.c_str())) ui.emit(GoTo{*back});
  }
  if (s.pose) {
    if (button("Key", "key pose", true, "Pull the motion through this pose (K): a starting guess, which Run may move",
               true))
      ui.emit(KeyPose{});
    if (button("Drop", "drop pose", true, "Forget this pose")) ui.emit(SetPose{});
  }
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
    ui.control(std::string("daemon ") + name, text);
    ImGui::SameLine(0, ui.scaled(14));
  };
  daemon("symbolic", s.symbolic);
  daemon("optimizer", s.optimizer);
  if (s.film) {
    ImGui::TextUnformatted(
        fmt::format("Making {}: {}", fs::path(s.film->first).filename().string(), s.film->second).c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("Stop##film")) ui.emit(DropFilm{});
    ui.control("stop film", "Give the film up; pictures that are finished stay.");
    ImGui::SameLine(0, ui.scaled(14));
  }
  bool told = false;
  for (std::size_t i = s.notices.size(); i-- > 0 && !told;) {
    const Notice& notice = s.notices[i];
    if (notice.place != Notice::Place::status) continue;
    told = true;
    ImGui::TextColored(ui.colour(notice.severity), "%s", notice.text.c_str());
    if (ImGui::IsItemClicked()) ui.emit(Dismiss{static_cast<int>(i)});
    ui.control("notice", notice.text + "\nClick to put this away.");
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
