#include "gui/views/files.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <string_view>

#include "common/diagnostic.h"
#include "gui/render/pattern.h"
#include "gui/views/dialogs.h"

namespace spacetime::gui {
namespace {

namespace fs = std::filesystem;

constexpr int strip_poses = 12;

// The folder, of which files with these endings are shown; clicked, they are named.
void list_folder(Ui& ui, std::initializer_list<std::string_view> endings) {
  FilesMemory& m = ui.memory.files;
  std::vector<std::pair<bool, std::string>> names;  // not a folder, name: folders come first
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(m.folder, failed)) {
    const std::string name = entry.path().filename();
    const bool folder = entry.is_directory(failed);
    if (name.starts_with('.') || (!folder && !std::ranges::count(endings, entry.path().extension().string()))) continue;
    names.emplace_back(!folder, name);
  }
  std::ranges::sort(names);
  ImGui::BeginChild("files", {0, ui.scaled(260)}, true);
  if (ImGui::Selectable("../")) m.folder = fs::path(m.folder).parent_path();
  ui.control("folder above", "The folder that this one is in.");
  for (const auto& [plain, name] : names) {
    if (ImGui::Selectable((plain ? name : name + "/").c_str(), m.name == name)) {
      if (plain)
        m.name = name;
      else
        m.folder = fs::path(m.folder) / name;
    }
    ui.control("file " + name, plain ? "Choose this name." : "Go into this folder.");
  }
  if (failed) ImGui::TextColored(ui.colours().bad, "This folder cannot be read.");
  ImGui::EndChild();
}

// What a film's name says will be made.
const char* film_kind(const std::string& name) {
  if (name.ends_with(".mp4")) return "A film, made by ffmpeg.";
  if (name.ends_with(".png") && name.find('%') != std::string::npos) return "A picture for every frame.";
  if (name.ends_with(".png")) return "One picture with twelve poses, like the strips in the papers.";
  return nullptr;
}

bool is_strip(const std::string& name) { return name.ends_with(".png") && name.find('%') == std::string::npos; }

// Whether what it would write is there already: of numbered pictures, the first.
bool is_there(const fs::path& file) {
  std::error_code none;
  try {
    const auto pattern = pattern_of(file);
    return fs::exists(pattern ? fs::path(pattern->file(0)) : file, none);
  } catch (const InputError&) {
    return false;  // `render` will say what is wrong with it
  }
}

void draw_film(Ui& ui) {
  FilesMemory& m = ui.memory.files;
  if (!ImGui::IsPopupOpen("Make a film")) {
    ImGui::OpenPopup("Make a film");
    m.folder = ui.state.file.empty() ? fs::current_path() : fs::absolute(ui.state.file).parent_path();
    m.name = ui.state.file.empty() ? "film.mp4" : fs::path(ui.state.file).stem().string() + ".mp4";
  }
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({ui.scaled(560), 0});
  if (!ImGui::BeginPopupModal("Make a film", nullptr, ImGuiWindowFlags_NoResize)) return;
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", m.folder.c_str());
  ImGui::PopTextWrapPos();
  list_folder(ui, {".mp4", ".png"});
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##film", &m.name);
  ui.control("film name",
             "film.mp4: a film; strip.png: poses in one picture; frames/%04d.png: a picture for every frame.");
  const char* kind = film_kind(m.name);
  ImGui::TextWrapped("%s", kind ? kind : "Name it film.mp4, strip.png, or frames/%04d.png.");
  ImGui::Checkbox("From where the window looks", &m.as_seen);
  ui.control("film camera", "Otherwise from where all of the motion can be seen.");
  const fs::path file = fs::path(m.folder) / m.name;
  if (kind && is_there(file))
    ImGui::TextColored(ui.colours().warning, file.string().find('%') == std::string::npos
                                                 ? "This file will be replaced."
                                                 : "Pictures of these names will be replaced.");
  if (!kind) ImGui::BeginDisabled();
  const bool pressed = ImGui::Button("Make", {ui.scaled(100), 0});
  ui.control("make film", "It is made while the window goes on; the status line tells how far it is.");
  if (!kind) ImGui::EndDisabled();
  ImGui::SameLine();
  if (pressed && kind)
    ui.emit(Film{file, is_strip(m.name) ? strip_poses : 0, m.as_seen ? camera_text(ui.memory.scene.camera) : ""});
  const bool left = ImGui::Button("Cancel", {ui.scaled(100), 0});
  ui.control("cancel file", "Back without doing anything (Esc).");
  const bool cancelled = left || escaped();
  if (cancelled || pressed) {
    m.dialog = FilesMemory::Dialog::none;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace

bool escaped() { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)); }

void draw_files(Ui& ui) {
  FilesMemory& m = ui.memory.files;
  if (m.dialog == FilesMemory::Dialog::film) return draw_film(ui);
  const bool open = m.dialog == FilesMemory::Dialog::open;
  if (m.dialog == FilesMemory::Dialog::none) return;
  const char* title = open ? "Open a scene" : "Save the scene";
  if (!ImGui::IsPopupOpen(title)) {
    ImGui::OpenPopup(title);
    const fs::path file = ui.state.file.empty() ? fs::path() : fs::absolute(ui.state.file);
    m.folder = file.empty() ? fs::current_path() : file.parent_path();
    m.name = open ? "" : file.empty() ? "untitled.scene" : std::string(file.filename());
  }
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({ui.scaled(560), 0});
  if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_NoResize)) return;
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", m.folder.c_str());
  ImGui::PopTextWrapPos();
  list_folder(ui, {".scene"});
  ImGui::SetNextItemWidth(-1);
  if (!open && ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputText("##name", &m.name, ImGuiInputTextFlags_EnterReturnsTrue);
  ui.control("file name", "Of the file, in the folder above; Enter takes it.");
  const fs::path chosen = fs::path(m.folder) / m.name;
  std::error_code none;
  const bool exists = !m.name.empty() && fs::is_regular_file(chosen, none);
  if (!open && exists) ImGui::TextColored(ui.colours().warning, "This file will be replaced.");
  const bool possible = open ? exists : !m.name.empty();
  if (!possible) ImGui::BeginDisabled();
  const bool pressed = ImGui::Button(open ? "Open" : "Save", {ui.scaled(100), 0});
  ui.control("confirm file", open ? "Open this file." : "Write the scene into this file.");
  if (!possible) ImGui::EndDisabled();
  ImGui::SameLine();
  const bool left = ImGui::Button("Cancel", {ui.scaled(100), 0});
  ui.control("cancel file", "Back without doing anything (Esc).");
  const bool cancelled = left || escaped();
  if (possible && (pressed || entered)) {
    if (open)
      leave_for(ui, {Leaving::To::file, chosen});
    else
      ui.emit(Save{chosen});
    if (!open && ui.memory.leaving) ui.memory.leaving->stage = Leaving::Stage::saving;
  } else if (cancelled && !open) {
    ui.memory.leaving.reset();
  }
  if (cancelled || (possible && (pressed || entered))) {
    m.dialog = FilesMemory::Dialog::none;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace spacetime::gui
