#include "gui/views/toolbar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "gui/views/acts.h"
#include "gui/views/optimisation.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

namespace fs = std::filesystem;

// What was done since an entry of the log, in a line or two.
std::string acts_behind(const State& s, std::optional<int> entry) {
  constexpr std::size_t most = 160;
  std::string text;
  for (int i = entry.value_or(s.present) + 1; i <= s.present; ++i)
    text += (text.empty() ? "" : "; ") + in_one_line(s.log[static_cast<std::size_t>(i)].text);
  if (text.empty()) return "what is being done";
  return text.size() <= most ? text : text.substr(0, most) + "...";
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

}  // namespace

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

}  // namespace spacetime::gui
