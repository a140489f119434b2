#include "gui/views/layout.h"

#include <algorithm>

#include "gui/views/constants.h"
#include "gui/views/dialogs.h"
#include "gui/views/equations.h"
#include "gui/views/freedoms.h"
#include "gui/views/menu.h"
#include "gui/views/optimisation.h"
#include "gui/views/shortcuts.h"
#include "gui/views/texts.h"
#include "gui/views/timeline.h"
#include "gui/views/toolbar.h"

namespace spacetime::gui {
namespace {

constexpr float gap = 6;  // between panels, pixels at scale 1; also what is dragged to resize them

// Between two panels; `size` is that of the panel it resizes, which grows by `sign` times the mouse's movement.
void draw_splitter(Ui& ui, const char* name, const Rect& r, float& size, float sign, float least, float most) {
  ImGui::SetCursorPos({r.x, r.y});
  ImGui::InvisibleButton(name, {std::max(1.0F, r.width), std::max(1.0F, r.height)});
  ui.control(name, "Drag to share the room out anew.");
  const bool upright = r.width < r.height;
  if (ImGui::IsItemHovered() || ImGui::IsItemActive())
    ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  if (ImGui::IsItemActive())
    size += sign * (upright ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y) / ui.memory.scale;
  size = std::clamp(size, least, std::max(least, most));
}

struct Tab {
  const char* name;
  const char* help;
  void (*draw)(Ui&);
};

void draw_tabs(Ui& ui, const char* id, std::initializer_list<Tab> tabs, int& wanted) {
  if (!ImGui::BeginTabBar(id)) return;
  int index = 0;
  for (const Tab& tab : tabs) {
    const bool open = ImGui::BeginTabItem(tab.name, nullptr, wanted == index ? ImGuiTabItemFlags_SetSelected : 0);
    ui.control(std::string("tab ") + tab.name, tab.help);
    if (open) {
      ImGui::BeginChild(tab.name, {0, 0}, false, 0);
      tab.draw(ui);
      ImGui::EndChild();
      ImGui::EndTabItem();
    }
    ++index;
  }
  wanted = -1;
  ImGui::EndTabBar();
}

template <class Draw>
void panel(const char* name, const Rect& r, const Draw& draw, ImGuiWindowFlags flags = 0) {
  ImGui::SetCursorPos({r.x, r.y});
  if (ImGui::BeginChild(name, {r.width, r.height}, true, flags | ImGuiWindowFlags_AlwaysUseWindowPadding)) draw();
  ImGui::EndChild();
}

}  // namespace

void draw_window(Ui& ui, SceneView& scene) {
  Memory& m = ui.memory;
  m.places.clear();
  m.helped.clear();
  m.helping = false;
  refresh(ui);
  take_keys(ui);
  // A scene with mistakes shows them.
  const bool wrong = ui.state.scene && !ui.state.scene->diagnostics.empty();
  if (wrong && m.mistaken != ui.state.scene) {
    m.tab_right = scene_tab;
    m.scroll_to_line = ui.state.scene->diagnostics.front().span.line;
  }
  m.mistaken = wrong ? ui.state.scene : nullptr;
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport.Pos);
  ImGui::SetNextWindowSize(viewport.Size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::Begin("Spacetime", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar(3);
  draw_menu(ui);

  // Panels keep their sizes and the scene view takes what is left, but never less than a third.
  const float g = ui.scaled(gap), width = viewport.Size.x, top = ImGui::GetCursorPosY() + g;
  const float tools = ImGui::GetFrameHeight(), status = ImGui::GetTextLineHeight() + 2 * g;
  const float upper = top + tools + g, lower = viewport.Size.y - status;
  const float across = width / m.scale, down = (lower - upper) / m.scale;
  m.left = std::clamp(m.left, 180.0F, std::max(180.0F, across * 0.34F));
  m.right = std::clamp(m.right, 180.0F, std::max(180.0F, across * 0.34F));
  m.bottom = std::clamp(m.bottom, 120.0F, std::max(120.0F, down * 0.67F));
  const float left = ui.scaled(m.left), right = ui.scaled(m.right), bottom = ui.scaled(m.bottom);
  const float middle = lower - bottom - g, centre = width - left - right - 4 * g;

  ImGui::SetCursorPos({g + 2, top});
  draw_toolbar(ui);
  draw_splitter(ui, "left edge", {g + left, upper, g, middle - upper}, m.left, 1, 180, across * 0.34F);
  draw_splitter(ui, "right edge", {width - right - 2 * g, upper, g, middle - upper}, m.right, -1, 180, across * 0.34F);
  draw_splitter(ui, "bottom edge", {g, middle, width - 2 * g, g}, m.bottom, -1, 120, down * 0.67F);

  panel("left", {g, upper, left, middle - upper}, [&] {
    draw_tabs(
        ui, "tables",
        {{"Equations", "What must hold and what is best: switch, weigh, edit, add.", draw_equations},
         {"Constants", "Numbers of the scene that can be dragged while the motion follows.", draw_constants},
         {"Freedom", "Which degrees of freedom may change, their bounds, and which curves are shown.", draw_freedoms}},
        m.tab_left);
  });
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  panel(
      "scene", {left + 2 * g, upper, centre, middle - upper}, [&] { scene.draw(ui); },
      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  panel("right", {width - right - g, upper, right, middle - upper}, [&] {
    draw_tabs(ui, "tools",
              {{"Optimise", "How the motion is found, and how far it is.", draw_optimisation},
               {"Scene", "The scene's text, with its mistakes.", draw_text},
               {"Log", "Every act, to go back to.", draw_log},
               {"Console", "Ask for the value, the derivative or the cost of an expression.", draw_console}},
              m.tab_right);
  });
  panel(
      "bottom", {g, middle + g, width - 2 * g, bottom - g}, [&] { draw_timeline(ui); },
      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::SetCursorPos({2 * g, lower + g});
  draw_status(ui);
  draw_dialogs(ui);
  ImGui::End();
  end_lost_drags(ui);
}

}  // namespace spacetime::gui
