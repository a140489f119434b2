#include "gui/views/scene_view.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>

#include "gui/places.h"
#include "gui/render/figures.h"
#include "gui/render/renderer.h"
#include "gui/render/target.h"
#include "gui/scene_picture.h"
#include "gui/views/grip.h"
#include "gui/views/scene_words.h"

namespace spacetime::gui {
namespace {

glm::vec2 as_vector(const ImVec2& v) { return {v.x, v.y}; }

bool is_software() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view renderer = name ? name : "";
  return renderer.find("llvmpipe") != std::string_view::npos || renderer.find("softpipe") != std::string_view::npos;
}

}  // namespace

struct SceneView::Resources {
  Renderer renderer;
  // Where the processor draws, smooth edges would cost more than all the rest.
  const bool on_processor = is_software();
  std::unique_ptr<Target> target;
  std::shared_ptr<const Problem> problem;
  std::unique_ptr<Figures> figures;
  Pull pull;

  void fit(int width, int height) {
    if (!target || target->width() != width || target->height() != height)
      target = std::make_unique<Target>(width, height, on_processor ? 1 : 4);
  }
  void know(const std::shared_ptr<const Problem>& wanted) {
    if (problem == wanted) return;
    problem = wanted;
    figures = std::make_unique<Figures>(*problem);
  }
};

SceneView::SceneView() : resources_(std::make_unique<Resources>()) {}
SceneView::~SceneView() = default;

namespace {

// What has no extent, such as a bead that does not move yet, is not looked at from within a hand's breadth.
Box with_room(Box box) {
  constexpr float least = 0.25F, instead = 0.5F;  // m: across, and to each side
  const glm::vec3 size = box.size(), middle = box.centre();
  if (!box.empty() && std::max({size.x, size.y, size.z}) < least) box.include({middle - instead, middle + instead});
  return box;
}

void frame_all(Ui& ui, const Figures& figures, const Motion& motion, const glm::vec2& size) {
  const Box moved = figures.bounds(motion);
  Box box = moved;
  for (const PlaceHandle& place : places_of(*ui.state.scene->problem))
    box.include(glm::vec3(at(place, ui.question().constants)));
  SceneMemory& m = ui.memory.scene;
  m.ground = ground_height(moved);
  // Above the legend: framed as in a picture without its rows, from as far away as leaves them below.
  const float rows = m.legend ? std::min(ui.scaled(50), size.y / 4) : 0;
  m.camera = frame(m.camera, with_room(box), {size.x, size.y - rows}, 0.08F);
  m.camera.distance *= size.y / (size.y - rows);
  m.camera = pan(m.camera, {0, -rows / 2}, size);
  m.framed = true;
  m.grounded = ui.state.revision;
}

// The camera stays where the person has it, whatever becomes of the motion: only a scene that is opened, and who asks
// for it, frames the figure anew.
void look(Ui& ui, const Figures& figures, const glm::vec2& size) {
  const State& s = ui.state;
  SceneMemory& m = ui.memory.scene;
  const bool another = !s.log.empty() && m.framed_for != s.opened;
  const bool settled = s.running || s.steering || m.grounded == s.revision;
  if (m.framed && !another && settled) return;
  const Motion motion = motion_of(s, false);
  if (another) {
    m.framed_for = s.opened;
    m.framed = false;
    m.camera = SceneMemory().camera;  // whatever the scene before was looked at from
    if (!planar(figures.bounds(motion))) m.camera = looking(View::free, m.camera);
  }
  if (!m.framed) return frame_all(ui, figures, motion, size);
  if (settled) return;
  m.grounded = s.revision;
  m.ground = std::min(m.ground, ground_height(figures.bounds(motion)));  // nothing sinks into it
}

// Handles of places, drawn over the picture; which one the mouse is at.
std::optional<PlaceHandle> draw_places(Ui& ui, const ImVec2& corner, const glm::vec2& size, const Pull& pull) {
  std::optional<PlaceHandle> hot;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const glm::vec2 mouse = as_vector(ImGui::GetIO().MousePos);
  for (const PlaceHandle& place : places_of(*ui.state.scene->problem)) {
    const glm::vec3 where(at(place, ui.question().constants));
    const auto seen = project(ui.memory.scene.camera, size, where);
    if (!seen) continue;
    const ImVec2 here{corner.x + seen->x, corner.y + seen->y};
    const bool mine = pull.what == Pull::What::place && pull.place.name == place.name;
    const bool near = glm::length(mouse - as_vector(here)) < ui.scaled(12);
    if (near) hot = place;
    const float r = ui.scaled(near || mine ? 10 : 8);
    const ImU32 colour = packed(near || mine ? ui.colours().text : ui.colours().warning);
    list.AddCircle(here, r, colour, 24, ui.scaled(2));
    list.AddLine({here.x - r - 4, here.y}, {here.x - r + 4, here.y}, colour, ui.scaled(2));
    list.AddLine({here.x + r - 4, here.y}, {here.x + r + 4, here.y}, colour, ui.scaled(2));
    list.AddLine({here.x, here.y - r - 4}, {here.x, here.y - r + 4}, colour, ui.scaled(2));
    list.AddLine({here.x, here.y + r - 4}, {here.x, here.y + r + 4}, colour, ui.scaled(2));
    const float wide = ImGui::CalcTextSize(place.name.c_str()).x, beside = r + 6;
    const bool fits = here.x + beside + wide < corner.x + size.x;
    list.AddText({fits ? here.x + beside : here.x - beside - wide, here.y - ImGui::GetFontSize() / 2}, colour,
                 place.name.c_str());
    ui.memory.places["place " + place.name] = {here.x - r, here.y - r, 2 * r, 2 * r};
  }
  return hot;
}

// Where the figure's parts are seen, by name.
void note_parts(Ui& ui, const Picture& picture, const Figures& figures, const ImVec2& corner, const glm::vec2& size) {
  for (const Solid& solid : picture.solids) {
    if (solid.id < 0 || solid.layer > 0) continue;
    const glm::vec4 middle =
        solid.pose * glm::vec4(solid.extent * (solid.shape == Solid::Shape::capsule ? 0.5F : 0.0F), 1);
    const auto seen = project(ui.memory.scene.camera, size, glm::vec3(middle));
    if (seen)
      ui.memory.places["part " + figures.name(solid.id)] = {corner.x + seen->x - 1, corner.y + seen->y - 1, 2, 2};
  }
}

void draw_nothing(Ui& ui, const glm::vec2& size) {
  const State& s = ui.state;
  const bool open = s.scene != nullptr || s.work.opening;
  const char* text = !open                         ? "Open a scene, or begin with an example."
                     : s.work.opening              ? "The scene is being compiled."
                     : s.scene && s.scene->problem ? "Waiting for the optimizer."
                                                   : "The scene has mistakes: its text says where.";
  const ImVec2 extent = ImGui::CalcTextSize(text);
  ImGui::SetCursorPos({(size.x - extent.x) / 2, size.y / 2 - extent.y});
  ImGui::TextDisabled("%s", text);
  if (open) return;
  ImGui::SetCursorPos({size.x / 2 - ui.scaled(60), size.y / 2 + ui.scaled(8)});
  if (ImGui::Button("Examples...", {ui.scaled(120), 0})) ui.memory.welcome = true;
  ui.control("examples", "Scenes that come with the program, to try and to change.");
}

}  // namespace

void SceneView::draw(Ui& ui) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const glm::vec2 size(std::max(1.0F, room.x), std::max(1.0F, room.y));
  const State& s = ui.state;
  if (!s.scene || !s.scene->problem || !s.curves) return draw_nothing(ui, size);
  Resources& r = *resources_;
  r.know(s.scene->problem);
  r.fit(static_cast<int>(size.x), static_cast<int>(size.y));
  const SceneMemory& m = ui.memory.scene;
  look(ui, *r.figures, size);
  Picture picture = picture_of(s, ui.question(), ui.residuals(), *r.figures, {m.trails, m.ghosts, m.forces, m.marks});
  picture.ground_height = m.ground;
  r.target->bind();
  r.renderer.draw(picture, m.camera, r.target->width(), r.target->height(), Quality::fast);
  ImGui::InvisibleButton("scene", {size.x, size.y});
  ImGui::SetItemAllowOverlap();  // messages stand over it
  ui.here("scene");
  // The texture's first row is the lowest.
  ImGui::GetWindowDrawList()->AddImageRounded(
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(r.target->texture())), corner,
      {corner.x + size.x, corner.y + size.y}, {0, 1}, {1, 0}, IM_COL32_WHITE, ui.scaled(6));
  note_parts(ui, picture, *r.figures, corner, size);
  const auto hot = draw_places(ui, corner, size, r.pull);
  take_mouse(ui, r.pull, picture, *r.figures, hot, corner, size);
  draw_words(ui, picture, corner, size);
}

}  // namespace spacetime::gui
