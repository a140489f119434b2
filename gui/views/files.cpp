#include "gui/views/files.h"

#include <fmt/format.h>
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
constexpr int most_edge = 8192, most_pictures = 100000;

constexpr double looked_again = 1;  // s: folders and files are looked at no more often, wherever they lie

// Where the program was started; the root where that is no more.
fs::path here() {
  std::error_code gone;
  const fs::path folder = fs::current_path(gone);
  return gone ? fs::path("/") : folder;
}

// The folder that a file is in.
fs::path folder_of(const std::string& file) { return file.empty() ? here() : (here() / file).parent_path(); }

const Listing& listing(FilesMemory& m, std::initializer_list<std::string_view> endings) {
  Listing& list = m.listing;
  if (list.folder == m.folder && list.since >= 0 && ImGui::GetTime() - list.since < looked_again) return list;
  list = {};
  list.folder = m.folder;
  list.since = ImGui::GetTime();
  const Entries entries = entries_of(m.folder);
  list.failed = entries.failed;
  for (const fs::directory_entry& entry : entries.all) {
    std::error_code none;
    const std::string name = entry.path().filename();
    const bool folder = entry.is_directory(none);
    if (name.starts_with('.') || (!folder && !std::ranges::count(endings, entry.path().extension().string()))) continue;
    list.names.emplace_back(!folder, name);
  }
  std::ranges::sort(list.names);
  return list;
}

const Looked& look_at(FilesMemory& m, const fs::path& file) {
  Looked& looked = m.looked;
  if (looked.file == file && looked.since >= 0 && ImGui::GetTime() - looked.since < looked_again) return looked;
  std::error_code none;
  const fs::file_status status = fs::status(file, none);
  looked = {file, ImGui::GetTime(), fs::exists(status), fs::is_regular_file(status)};
  return looked;
}

// The folder, of which files with these endings are shown; clicked, they are named.
void list_folder(Ui& ui, std::initializer_list<std::string_view> endings, float height = 260) {
  FilesMemory& m = ui.memory.files;
  const Listing& list = listing(m, endings);
  ImGui::BeginChild("files", {0, ui.scaled(height)}, true);
  if (ImGui::Selectable("../")) m.folder = fs::path(m.folder).parent_path();
  ui.control("folder above", "The folder that this one is in.");
  for (const auto& [plain, name] : list.names) {
    if (ImGui::Selectable((plain ? name : name + "/").c_str(), m.name == name)) {
      if (plain)
        m.name = name;
      else
        m.folder = fs::path(m.folder) / name;
    }
    ui.control("file " + name, plain ? "Choose this name." : "Go into this folder.");
  }
  if (list.failed) ImGui::TextColored(ui.colours().bad, "This folder cannot be read.");
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
bool is_there(FilesMemory& m, const fs::path& file) {
  try {
    const auto pattern = pattern_of(file);
    return look_at(m, pattern ? fs::path(pattern->file(0)) : file).there;
  } catch (const InputError&) {
    return false;  // `render` will say what is wrong with it
  }
}

// As the window shows the motion: as large, as fast, and what the timeline shows of it.
void begin_film(Ui& ui) {
  FilesMemory& m = ui.memory.files;
  const State& s = ui.state;
  m.folder = folder_of(s.file);
  m.listing = {};
  m.name = s.file.empty() ? "film.mp4" : fs::path(s.file).stem().string() + ".mp4";
  const auto scene = ui.memory.places.find("scene");
  const Rect room = scene == ui.memory.places.end() ? Rect{0, 0, 1280, 720} : scene->second;
  m.size[0] = 2 * static_cast<int>(room.width / 2);  // films have even edges
  m.size[1] = 2 * static_cast<int>(room.height / 2);
  m.rate = s.playback.rate;
  const SpanMemory& span = ui.memory.span;
  m.span[0] = span.from < span.to ? span.from : s.scene->problem->start;
  m.span[1] = span.from < span.to ? span.to : s.scene->problem->end;
}

// Why it cannot be made as it is asked for; nothing where it can.
std::string film_fault(const Ui& ui) {
  const FilesMemory& m = ui.memory.files;
  const Problem& problem = *ui.state.scene->problem;
  const auto usable = [](int edge) { return edge >= 16 && edge <= most_edge; };
  if (ui.state.running || ui.state.steering) return "The motion is still changing: wait for it, or stop the run.";
  if (!film_kind(m.name)) return "Name it film.mp4, strip.png, or frames/%04d.png.";
  if (!usable(m.size[0]) || !usable(m.size[1]))
    return fmt::format("Each edge of a picture has from 16 to {} pixels.", most_edge);
  if (!(m.span[0] >= problem.start && m.span[1] <= problem.end && m.span[0] < m.span[1]))
    return fmt::format("The motion lasts from {:.6g} to {:.6g} s: choose a part of it.", problem.start, problem.end);
  if (is_strip(m.name)) return "";
  if (!(m.rate > 0 && m.rate <= 1000)) return "The rate is more than 0 and at most 1000 pictures a second.";
  if (m.rate * (m.span[1] - m.span[0]) > most_pictures)
    return fmt::format("These would be more than {} pictures: choose a lower rate.", most_pictures);
  return "";
}

// Size, rate and part of the motion.
void draw_film_choices(Ui& ui) {
  FilesMemory& m = ui.memory.files;
  const auto field = [&](const char* before, float width) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", before);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ui.scaled(width));
  };
  field("Size", 120);
  ImGui::InputInt2("##size", m.size);
  ui.control("film size", "Pixels across and down; at first as large as the figure is shown here.");
  ImGui::SameLine();
  field("Time", 130);
  ImGui::InputScalarN("##span", ImGuiDataType_Double, m.span, 2, nullptr, nullptr, "%.4g");
  ui.control("film span", "From when to when, in seconds; at first what the timeline shows.");
  if (is_strip(m.name)) return;
  ImGui::SameLine();
  field("Rate", 60);
  ImGui::InputDouble("##rate", &m.rate, 0, 0, "%.4g");
  ui.control("film rate", "Pictures a second; at first those of the timeline.");
}

void draw_film(Ui& ui) {
  FilesMemory& m = ui.memory.files;
  if (!ui.state.scene || !ui.state.scene->problem) {  // it has gone meanwhile
    m.dialog = FilesMemory::Dialog::none;
    return;
  }
  if (!ImGui::IsPopupOpen("Make a film")) {
    ImGui::OpenPopup("Make a film");
    begin_film(ui);
  }
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({ui.scaled(560), 0});
  if (!ImGui::BeginPopupModal("Make a film", nullptr, ImGuiWindowFlags_NoResize)) return;
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", m.folder.c_str());
  ImGui::PopTextWrapPos();
  list_folder(ui, {".mp4", ".png"}, 200);
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##film", &m.name);
  ui.control("film name",
             "film.mp4: a film; strip.png: poses in one picture; frames/%04d.png: a picture for every frame.");
  const char* kind = film_kind(m.name);
  const std::string fault = film_fault(ui);
  draw_film_choices(ui);
  ImGui::Checkbox("From where the window looks", &m.as_seen);
  ui.control("film camera", "Otherwise from where all of the motion can be seen.");
  if (fault.empty())
    ImGui::TextWrapped("%s", kind);
  else
    ImGui::TextColored(ui.colours().bad, "%s", fault.c_str());
  const bool possible = fault.empty();
  const fs::path file = fs::path(m.folder) / m.name;
  if (possible && is_there(m, file))
    ImGui::TextColored(ui.colours().warning, file.string().find('%') == std::string::npos
                                                 ? "This file will be replaced."
                                                 : "Pictures of these names will be replaced.");
  if (!possible) ImGui::BeginDisabled();
  const bool pressed = ImGui::Button("Make", {ui.scaled(100), 0});
  ui.control("make film", "It is made while the window goes on; the status line tells how far it is.");
  if (!possible) ImGui::EndDisabled();
  ImGui::SameLine();
  if (pressed && possible) {
    Film film{.file = file, .strip = is_strip(m.name) ? strip_poses : 0};
    if (m.as_seen) film.camera = camera_text(ui.memory.scene.camera);
    film.width = m.size[0];
    film.height = m.size[1];
    film.rate = m.rate;
    film.span = {m.span[0], m.span[1]};
    ui.emit(std::move(film));
  }
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

Entries entries_of(const fs::path& folder) {
  Entries found;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    found.all.push_back(*entry);
  found.failed = static_cast<bool>(failed);
  return found;
}

bool escaped() { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)); }

void draw_files(Ui& ui) {
  FilesMemory& m = ui.memory.files;
  if (m.dialog == FilesMemory::Dialog::film) return draw_film(ui);
  const bool open = m.dialog == FilesMemory::Dialog::open;
  if (m.dialog == FilesMemory::Dialog::none) return;
  const char* title = open ? "Open a scene" : "Save the scene";
  if (!ImGui::IsPopupOpen(title)) {
    ImGui::OpenPopup(title);
    const fs::path file = ui.state.file;
    m.folder = folder_of(file);
    m.listing = {};
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
  const bool exists = !m.name.empty() && look_at(m, chosen).regular;
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
