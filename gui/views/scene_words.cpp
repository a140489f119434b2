#include "gui/views/scene_words.h"

#include <algorithm>
#include <array>

#include "gui/render/palette.h"
#include "gui/views/legend.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

constexpr int most_lines = 3;  // of what is written over the figure

// As much of the text as fits into a few lines.
std::string fitted(std::string text, float width) {
  const float most = (static_cast<float>(most_lines) + 0.5F) * ImGui::GetTextLineHeight();
  const auto height = [&] { return ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y; };
  bool cut = false;
  while (text.size() > 8 && height() > most) {
    text.resize(text.size() - 8);
    cut = true;
  }
  return cut ? text.substr(0, text.size() - 4) + "..." : text;
}

// Whether any part of the figure is, or would be if others did not hide it.
bool is_in_view(const Ui& ui, const Picture& picture, const glm::vec2& size) {
  return std::ranges::any_of(picture.solids, [&](const Solid& solid) {
    if (solid.layer != 0) return false;
    const auto seen = project(ui.memory.scene.camera, size, bounds(solid).centre());
    return seen && seen->x >= 0 && seen->y >= 0 && seen->x <= size.x && seen->y <= size.y;
  });
}

// What is being done, or has to be, in the middle; its lower end.
float draw_doing(Ui& ui, const Picture& picture, const ImVec2& corner, const glm::vec2& size) {
  const State& s = ui.state;
  const float top = corner.y + ui.scaled(10), margin = ui.scaled(24);
  std::string text;
  if (s.steering)
    text = brief(s.steering->line);
  else if (s.pose)
    text = "A pose at " + shown(s.playback.time) + " s: K keys it, Esc drops it";
  else if (!picture.solids.empty() && !is_in_view(ui, picture, size))
    text = "The figure is out of sight: F frames its motion";
  ui.memory.scene.doing = text;
  if (text.empty()) return top;
  const float width = size.x - 2 * margin;
  text = fitted(text, width);
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
  const float x = corner.x + (size.x - extent.x) / 2;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ui.memory.places["doing"] = {x - 10, top - 4, extent.x + 20, extent.y + 8};
  list.AddRectFilled({x - 10, top - 4}, {x + extent.x + 10, top + extent.y + 4}, packed(ui.colours().panel, 0.9F), 5);
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x, top}, packed(ui.colours().text), text.c_str(), nullptr,
               width);
  return top + extent.y + ui.scaled(14);
}

void draw_notices(Ui& ui, float top, const ImVec2& corner, const glm::vec2& size) {
  if (std::ranges::count(ui.state.notices, Notice::Place::view, &Notice::place) == 0) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float margin = ui.scaled(24);
  list.ChannelsSplit(2);
  list.ChannelsSetCurrent(1);
  ImGui::SetCursorScreenPos({corner.x + margin, top});
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x - 2 * margin);
  ImGui::BeginGroup();
  ui.notices(Notice::Place::view);
  ImGui::EndGroup();
  ImGui::PopTextWrapPos();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  list.ChannelsSetCurrent(0);
  list.AddRectFilled({low.x - 10, low.y - 4}, {high.x + 10, high.y + 4}, packed(ui.colours().panel, 0.9F), 5);
  list.ChannelsMerge();
}

ImVec4 as_shown(const Colour& c) { return {c.red, c.green, c.blue, 1}; }

// Of what is in the picture, and of nothing else.
std::vector<Name> names_in(const Ui& ui, const Picture& picture) {
  const State& s = ui.state;
  const SceneMemory& m = ui.memory.scene;
  const Palette& colours = palette(picture.theme);
  const ImVec4 ink = as_shown(colours.ink);
  std::vector<Name> names;
  if (!picture.lines.empty()) names.push_back({"trail", as_shown(colours.faint), {Sample::Kind::line, 0}});
  struct Kind {
    Mark::Kind kind;
    const char* text;
    Colour colour;
  };
  const std::array<Kind, 4> kinds{{{Mark::Kind::met, "constraint holds", colours.met},
                                   {Mark::Kind::violated, "does not hold", colours.violated},
                                   {Mark::Kind::soft, "soft", colours.soft},
                                   {Mark::Kind::disabled, "switched off", colours.disabled}}};
  for (const Kind& kind : kinds)
    if (std::ranges::count(picture.marks, kind.kind, &Mark::kind) > 0)
      names.push_back({kind.text, as_shown(kind.colour), {Sample::Kind::mark, static_cast<int>(kind.kind)}});
  if (s.ghost) names.push_back({"ghost before the last edit or run", ink, {Sample::Kind::ghost, 0, 0.45F}});
  if (!s.pins.empty()) names.push_back({"pinned ghost", ink, {Sample::Kind::ghost, 0, 0.4F}});
  if (m.ghosts && !s.playback.playing)
    names.push_back({"ghosts along the motion", ink, {Sample::Kind::ghost, 0, 0.2F}});
  if (!picture.arrows.empty() || !picture.torques.empty())
    names.push_back({"joint forces", as_shown(colours.soft), {Sample::Kind::arrow}});
  return names;
}

void draw_legend(Ui& ui, const Picture& picture, const ImVec2& corner, const glm::vec2& size) {
  const std::vector<Name> names = names_in(ui, picture);
  const float margin = ui.scaled(12), width = size.x - 2 * margin, gap = ui.scaled(14);
  constexpr int rows = 2;
  const float height = arrange(names, corner, width, rows, gap).height;
  const Legend legend = arrange(names, {corner.x + margin, corner.y + size.y - margin - height}, width, rows, gap);
  draw(*ImGui::GetWindowDrawList(), legend, names, ui.colours(), true);
  if (!names.empty())
    ui.memory.places["scene legend"] = {corner.x + margin, corner.y + size.y - margin - height, legend.width, height};
}

}  // namespace

void draw_words(Ui& ui, const Picture& picture, const ImVec2& corner, const glm::vec2& size) {
  if (ui.memory.scene.legend) draw_legend(ui, picture, corner, size);
  const float below = draw_doing(ui, picture, corner, size);
  draw_notices(ui, below, corner, size);
}

}  // namespace spacetime::gui
