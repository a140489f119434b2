#include "gui/views/menu.h"

#include <filesystem>

#include "gui/views/acts.h"
#include "gui/views/dialogs.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

namespace fs = std::filesystem;

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
  if (entry(ui, {"Refine all", nullptr, there && s.scene->problem},
            "Halve the knot spans: the motion stays, and can become finer."))
    ui.act(refine_words(s.scene->problem->start, s.scene->problem->end, {}, 1).line);
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

}  // namespace spacetime::gui
