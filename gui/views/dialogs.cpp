#include "gui/views/dialogs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>

#include "common/diagnostic.h"
#include "common/files.h"
#include "gui/views/files.h"
#include "gui/views/new_scene.h"

namespace spacetime::gui {
namespace {

namespace fs = std::filesystem;

struct Example {
  std::string file, name, about, text;
};

// The first comment of a scene says what it is.
std::string first_comment(const std::string& text) {
  std::istringstream in(text);
  std::string line, about;
  while (std::getline(in, line) && !line.empty() && line[0] == '#') {
    about += (about.empty() ? "" : " ") + line.substr(std::min(line.size(), line.find_first_not_of("# ")));
    if (about.size() > 160) break;
  }
  return about.substr(0, about.find(". ") == std::string::npos ? about.size() : about.find(". ") + 1);
}

// Read once: they come with the program.  One that cannot be read is not offered.
const std::vector<Example>& examples() {
  static const std::vector<Example> all = [] {
    std::vector<Example> out;
    for (const fs::directory_entry& entry : entries_of(examples_folder()).all) {
      if (entry.path().extension() != ".scene") continue;
      std::string name = entry.path().stem();
      std::ranges::replace(name, '_', ' ');
      try {
        std::string text = read_text(entry.path());
        std::string about = first_comment(text);
        out.push_back({entry.path(), std::move(name), std::move(about), std::move(text)});
      } catch (const InputError&) {
        continue;
      }
    }
    // The throw first: it is what the program is about.
    std::ranges::sort(out, {}, [](const Example& e) { return std::pair(e.name != "throw", e.name); });
    return out;
  }();
  return all;
}

void draw_left_behind(Ui& ui) {
  if (ui.state.left.empty()) return;
  ImGui::PushFont(ui.memory.fonts.strong);
  ImGui::TextUnformatted("Not saved when it ended");
  ImGui::PopFont();
  for (const LeftBehind& left : ui.state.left) {
    const std::string name = name_of(left);
    const float room = ImGui::CalcTextSize("Forget it").x + 3 * ImGui::GetStyle().FramePadding.x;
    const ImVec2 size{ImGui::GetContentRegionAvail().x - room, 0};
    if (ImGui::Selectable(fmt::format("Go on with {}##{}", name, left.journal).c_str(), false, 0, size)) {
      leave_for(ui, {Leaving::To::file, left.journal});
      ui.memory.welcome = false;
      ImGui::CloseCurrentPopup();
    }
    ui.control("recover " + name, "Everything that was done in it comes back, undo included.");
    ImGui::SameLine();
    if (ImGui::SmallButton(("Forget it##" + left.journal).c_str())) ui.emit(DropSession{left.journal});
    ui.control("forget " + name, "What was not saved in it is thrown away for good.");
  }
  ImGui::Spacing();
}

void draw_welcome(Ui& ui) {
  if (ui.memory.welcome) ImGui::OpenPopup("Welcome");
  const ImVec2 centre = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(centre, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({ui.scaled(640), std::min(ui.scaled(560), ImGui::GetIO().DisplaySize.y * 0.9F)});
  if (!ImGui::BeginPopupModal("Welcome", &ui.memory.welcome, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove))
    return;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(
      "Spacetime finds motion. A scene says what moves, what must hold and what is best; press Run and watch the "
      "optimiser "
      "find it. Then change a weight, drag the basket, key a pose, and run again.");
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  draw_left_behind(ui);
  ImGui::PushFont(ui.memory.fonts.strong);
  ImGui::TextUnformatted("Begin with an example");
  ImGui::PopFont();
  ImGui::BeginChild("examples", {0, -ImGui::GetFrameHeightWithSpacing() - 4});
  for (const Example& example : examples()) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = ImGui::GetTextLineHeight() +
                         ImGui::CalcTextSize(example.about.c_str(), nullptr, false, width - ui.scaled(16)).y +
                         ui.scaled(10);
    if (ImGui::Selectable(("##" + example.file).c_str(), false, 0, {width, height})) {
      leave_for(ui, {Leaving::To::example, example.file});
      ui.memory.welcome = false;
      ImGui::CloseCurrentPopup();
    }
    ui.control("example " + example.name, "Open a copy of it: the example itself stays as it is.");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(ui.memory.fonts.strong, ImGui::GetFontSize(), {at.x + 8, at.y + 3}, packed(ui.colours().text),
                 example.name.c_str());
    list.AddText(nullptr, 0, {at.x + 8, at.y + 5 + ImGui::GetTextLineHeight()}, packed(ui.colours().faint),
                 example.about.c_str(), nullptr, width - ui.scaled(16));
  }
  if (examples().empty()) ImGui::TextDisabled("The examples were not found beside the program.");
  ImGui::EndChild();
  if (ImGui::Button("New scene")) {
    leave_for(ui, {Leaving::To::fresh});
    ui.memory.welcome = false;
    ImGui::CloseCurrentPopup();
  }
  ui.control("new scene", "Begin with a scene of a few lines that can be run and changed.");
  ImGui::SameLine();
  if (ImGui::Button("Open a file...")) {
    ui.memory.files.dialog = FilesMemory::Dialog::open;
    ui.memory.welcome = false;
    ImGui::CloseCurrentPopup();
  }
  ui.control("welcome open", "A scene of your own.");
  ImGui::SameLine();
  const bool closed = ImGui::Button("Close");
  ui.control("close welcome", "Put this away (Esc); File, Examples brings it back.");
  if (closed || escaped()) {
    ui.memory.welcome = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

void draw_shortcuts(Ui& ui) {
  static constexpr std::array<std::array<const char*, 2>, 22> all{{
      {"F5", "Run; pause what runs, and go on with it"},
      {"F10", "One iteration"},
      {"Esc", "Stop; close what is open"},
      {"Space", "Play or pause"},
      {"Left, Right", "One frame back or forward"},
      {"Home, End", "To the start or the end"},
      {"K", "Key the pose at the time shown"},
      {"Ctrl+Z", "Undo"},
      {"Ctrl+Shift+Z, Ctrl+Y", "Redo"},
      {"Ctrl+C, Ctrl+V", "Copy, paste a pose"},
      {"Ctrl+Shift+V", "Paste a pose mirrored"},
      {"Ctrl+N, Ctrl+O, Ctrl+S", "New scene, open, save"},
      {"Ctrl+E", "Examples"},
      {"1, 2, 3, 4", "View from the front, the side, above, freely"},
      {"F", "Frame the figure"},
      {"G", "Pin a ghost of the figure at the time shown"},
      {"Shift+G, T", "Ghosts along the motion, trails"},
      {"Ctrl+Q", "Quit"},
      {"F1", "This list"},
      {"Left button on a key", "Drag it to another time; right button takes it away"},
      {"Left button in the scene", "On the figure poses it, elsewhere turns the view"},
      {"Right or middle button, wheel", "Move the view, come closer"},
  }};
  if (ui.memory.shortcuts) ImGui::OpenPopup("Shortcuts");
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5F, 0.5F});
  if (!ImGui::BeginPopupModal("Shortcuts", &ui.memory.shortcuts, ImGuiWindowFlags_AlwaysAutoResize)) return;
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg)) {
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, ui.scaled(220));
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, ui.scaled(400));
    for (const auto& [key, what] : all) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextColored(ui.colours().accent, "%s", key);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(what);
    }
    ImGui::EndTable();
  }
  const bool closed = ImGui::Button("Close");
  ui.control("close shortcuts", "Put this list away (Esc).");
  if (closed || escaped()) ui.memory.shortcuts = false;
  if (!ui.memory.shortcuts) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void go(Ui& ui, const Leaving& leaving, bool discard) {
  ui.memory.leaving.reset();
  switch (leaving.to) {
    case Leaving::To::quit:
      ui.memory.discard = discard;
      ui.memory.quit = true;
      return;
    case Leaving::To::file:
      return ui.emit(Open{leaving.file, discard});
    case Leaving::To::fresh:
      return ui.emit(OpenText{std::string(new_scene), discard});
    case Leaving::To::example:
      // A copy without a file of its own: saving asks for one, and the example stays as it is.
      const auto example = std::ranges::find(examples(), leaving.file, &Example::file);
      if (example != examples().end()) ui.emit(OpenText{example->text, discard});
  }
}

// What was to come after saving comes when that is done, and not where it could not be done: the status line says why.
// A run is stopped first, so that its outcome is saved as well; where something else goes on by then it is asked again.
void go_on_after_saving(Ui& ui) {
  auto& leaving = ui.memory.leaving;
  if (!leaving) return;
  const bool busy = ui.state.running || ui.state.waiting > 0;
  if (leaving->stage == Leaving::Stage::stopping && !busy) {
    ui.emit(Save{});
    leaving->stage = Leaving::Stage::saving;
  } else if (leaving->stage == Leaving::Stage::saving && ui.state.saving.empty()) {
    if (busy)
      leaving->stage = Leaving::Stage::asking;
    else if (unsaved(ui.state))
      leaving.reset();
    else
      go(ui, Leaving(*leaving), false);
  }
}

// Of what would be lost, in the order of its weight.
void say_what_would_be_lost(const State& state) {
  const std::string name = state.file.empty() ? "This scene" : std::string(fs::path(state.file).filename());
  if (state.running)
    ImGui::TextUnformatted("A run goes on: what it has found so far would be lost.");
  else if (state.waiting > 0 || state.steering)
    ImGui::TextUnformatted("What was done last is not finished, and would be lost.");
  if (is_typing(state)) ImGui::TextUnformatted("A line that is being typed and was not applied would be lost.");
  if (unsaved(state)) ImGui::Text("%s has changes that are not saved.", name.c_str());
}

void draw_guard(Ui& ui) {
  if (!ui.memory.leaving || ui.memory.leaving->stage != Leaving::Stage::asking) return;
  if (!ImGui::IsPopupOpen("Unsaved changes")) ImGui::OpenPopup("Unsaved changes");
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5F, 0.5F});
  if (!ImGui::BeginPopupModal("Unsaved changes", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  say_what_would_be_lost(ui.state);
  ImGui::Spacing();
  const Leaving next = *ui.memory.leaving;
  if (ImGui::Button("Save", {ui.scaled(110), 0})) {
    if (ui.state.running) ui.emit(Stop{});
    if (ui.state.file.empty()) {
      ui.memory.files.dialog = FilesMemory::Dialog::save;
      ui.memory.leaving->stage = Leaving::Stage::naming;
    } else {
      ui.memory.leaving->stage = Leaving::Stage::stopping;
    }
    ImGui::CloseCurrentPopup();
  }
  ui.control("guard save", "Stop what runs, save, then go on.");
  ImGui::SameLine();
  const bool quits = next.to == Leaving::To::quit;
  if (ImGui::Button(quits ? "Discard and quit" : "Discard them", {ui.scaled(130), 0})) {
    go(ui, next, true);
    ImGui::CloseCurrentPopup();
  }
  ui.control("guard discard", "Go on without saving: the changes are lost.");
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {ui.scaled(110), 0}) || escaped()) {
    ui.memory.leaving.reset();
    ImGui::CloseCurrentPopup();
  }
  ui.control("guard cancel", "Stay with this scene.");
  ImGui::EndPopup();
}

}  // namespace

std::string name_of(const LeftBehind& left) {
  return left.file.empty() ? "a scene without a file" : std::string(fs::path(left.file).filename());
}

std::string examples_folder() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  for (const fs::path& folder : {program.parent_path() / "../share/spacetime/examples", fs::path(SPACETIME_EXAMPLES)})
    if (fs::is_directory(folder, none)) return fs::weakly_canonical(folder, none);
  return "";
}

void leave_for(Ui& ui, Leaving leaving) {
  if (!would_lose(ui.state)) return go(ui, leaving, false);
  ui.memory.leaving = std::move(leaving);
}

void draw_dialogs(Ui& ui) {
  go_on_after_saving(ui);
  draw_welcome(ui);
  draw_shortcuts(ui);
  draw_files(ui);
  draw_guard(ui);
}

}  // namespace spacetime::gui
