#include "gui/views/scene_view.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>

#include "gui/inverse_kinematics.h"
#include "gui/places.h"
#include "gui/render/figures.h"
#include "gui/render/renderer.h"
#include "gui/render/target.h"
#include "gui/scene_picture.h"
#include "gui/views/constants.h"

namespace spacetime::gui {
namespace {

// What is being dragged with the left button.
struct Pull {
  enum class What { nothing, camera, body, place } what = What::nothing;
  int body = -1;
  glm::dvec3 point{0};  // body: where it was taken hold of, in its own axes
  PlaceHandle place;
  glm::vec3 start{0};  // of the point in the world: the drag stays in the plane through it that faces the camera
};

glm::vec2 as_vector(const ImVec2& v) { return {v.x, v.y}; }

// Where a ray meets the plane through `point` that faces the camera.
std::optional<glm::vec3> meet(const Ray& ray, const glm::vec3& point, const Camera& camera) {
  const glm::vec3 normal = glm::normalize(camera.target - eye(camera));
  const float along = glm::dot(ray.direction, normal);
  if (along < 1e-4F) return std::nullopt;
  return ray.origin + ray.direction * (glm::dot(point - ray.origin, normal) / along);
}

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

void frame_all(Ui& ui, const Figures& figures, const Motion& motion, const glm::vec2& size) {
  Box box = figures.bounds(motion);
  if (ui.state.scene->problem)
    for (const PlaceHandle& place : places_of(*ui.state.scene->problem))
      box.include(glm::vec3(at(place, ui.question().constants)));
  ui.memory.scene.ground = ground_height(figures.bounds(motion));
  ui.memory.scene.camera = frame(ui.memory.scene.camera, box, size, 0.1F);
  ui.memory.scene.framed = true;
  ui.memory.scene.as_framed = ui.memory.scene.camera;
  ui.memory.scene.framed_at = ui.state.revision;
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
    list.AddText({here.x + r + 6, here.y - ImGui::GetFontSize() / 2}, colour, place.name.c_str());
    ui.memory.places["place " + place.name] = {here.x - r, here.y - r, 2 * r, 2 * r};
  }
  return hot;
}

Moment shown_moment(const Ui& ui) {
  return moment_of(motion_of(ui.state, true), ui.question().constants, ui.state.playback.time);
}

// Degrees of freedom of the body's creature that are in the window.
std::vector<std::string> movable(const Ui& ui, const Body& body) {
  std::vector<std::string> out;
  for (const Freedom& dof : ui.question().dofs)
    if (dof.in_window && creature_of(dof.name) == creature_of(body.name)) out.push_back(dof.name);
  return out;
}

void pull_body(Ui& ui, const Pull& pull, const glm::vec3& target) {
  const Problem& problem = *ui.state.scene->problem;
  if (static_cast<std::size_t>(pull.body) >= problem.bodies.size()) return;  // another scene has come meanwhile
  const Body& body = problem.bodies[static_cast<std::size_t>(pull.body)];
  const std::vector<std::string> free = movable(ui, body);
  if (free.empty()) return;
  std::map<std::string, std::pair<double, double>> bounds;
  for (const Freedom& dof : ui.question().dofs)
    if (dof.lower || dof.upper) bounds[dof.name] = {dof.lower.value_or(-1e300), dof.upper.value_or(1e300)};
  const auto values = reach(problem, body, shown_moment(ui), pull.point, glm::dvec3(target), free, bounds);
  Pose pose = ui.state.pose.value_or(Pose{});
  for (const std::string& name : free) pose.values[name] = values.at(name);
  ui.emit(SetPose{pose});
}

void pull_place(Ui& ui, const Pull& pull, const glm::vec3& target) {
  std::vector<std::pair<std::string, double>> constants;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string& name = pull.place.parts[static_cast<std::size_t>(axis)];
    if (!name.empty()) constants.emplace_back(name, std::round(target[axis] * 1e4) / 1e4);
  }
  ui.emit(Steer{setting(constants)});
}

// The point of a body under the mouse: where the ray comes nearest to its origin's depth is good enough to hold it by.
void take_hold(Ui& ui, Pull& pull, int body, const Ray& ray) {
  const Problem& problem = *ui.state.scene->problem;
  const Moment moment = shown_moment(ui);
  const BodyPose pose(problem, problem.bodies[static_cast<std::size_t>(body)]);
  const glm::dvec3 origin = pose.place(moment, glm::dvec3(0));
  const auto hit = meet(ray, glm::vec3(origin), ui.memory.scene.camera);
  if (!hit) return;
  // World to the body's axes: rows of the rotation are what unit vectors become.
  const glm::dvec3 away = glm::dvec3(*hit) - origin;
  for (int k = 0; k < 3; ++k) {
    glm::dvec3 unit(0);
    unit[k] = 1;
    pull.point[k] = glm::dot(pose.place(moment, unit) - origin, away);
  }
  pull.what = Pull::What::body;
  pull.body = body;
  pull.start = *hit;
}

// The index of the problem's body that a solid shows; -1 for none, and for a bead, which has no body.
int body_of(const Figures& figures, const Problem& problem, int id) {
  if (id < 0) return -1;
  const auto body = std::ranges::find(problem.bodies, figures.name(id), &Body::name);
  return body == problem.bodies.end() ? -1 : static_cast<int>(body - problem.bodies.begin());
}

void take_mouse(Ui& ui, Pull& pull, const Picture& picture, const Figures& figures,
                const std::optional<PlaceHandle>& hot, const ImVec2& corner, const glm::vec2& size) {
  Camera& camera = ui.memory.scene.camera;
  const ImGuiIO& io = ImGui::GetIO();
  const glm::vec2 pixel = as_vector(io.MousePos) - as_vector(corner), moved = as_vector(io.MouseDelta);
  const Ray ray = ray_through(camera, size, pixel);
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) camera = zoom(camera, std::pow(1.15F, io.MouseWheel), pixel, size);
  if (ImGui::IsItemHovered() && (ImGui::IsMouseDragging(1, 1) || ImGui::IsMouseDragging(2, 1)))
    camera = pan(camera, moved, size);
  if (ImGui::IsItemActivated()) {
    pull = Pull{};
    pull.what = Pull::What::camera;
    const int body = body_of(figures, *ui.state.scene->problem, pick(picture, ray));
    if (hot) {
      pull.what = Pull::What::place;
      pull.place = *hot;
      pull.start = glm::vec3(at(*hot, ui.question().constants));
    } else if (body >= 0) {
      take_hold(ui, pull, body, ray);
    }
  }
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, 2) && !ui.memory.drag_dropped) {
    if (pull.what == Pull::What::camera && (moved.x != 0 || moved.y != 0))
      camera = orbit(camera, -moved.x * 0.008F, moved.y * 0.008F);
    const auto target = meet(ray, pull.start, camera);
    const bool moving = moved.x != 0 || moved.y != 0;
    if (target && moving && pull.what == Pull::What::body) pull_body(ui, pull, *target);
    if (target && moving && pull.what == Pull::What::place) pull_place(ui, pull, *target);
  }
  if (ImGui::IsItemDeactivated()) {
    if (pull.what == Pull::What::place && ui.state.steering) ui.emit(Steered{true});
    pull = Pull{};
  }
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

void draw_words(Ui& ui, const ImVec2& corner, const glm::vec2& size) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const State& s = ui.state;
  std::string text;
  if (s.steering)
    text = s.steering->line;
  else if (s.pose)
    text = "A pose at " + shown(s.playback.time) + " s: K keys it, Esc drops it";
  if (!text.empty()) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    const float x = corner.x + (size.x - extent.x) / 2, y = corner.y + ui.scaled(10);
    list.AddRectFilled({x - 10, y - 4}, {x + extent.x + 10, y + extent.y + 4}, packed(ui.colours().panel, 0.85F), 5);
    list.AddText({x, y}, packed(ui.colours().text), text.c_str());
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
  SceneMemory& m = ui.memory.scene;
  if (!s.log.empty() && m.framed_for != s.log.front().scene) {
    m.framed_for = s.log.front().scene;
    m.framed = false;
    if (!planar(r.figures->bounds(motion_of(s, false)))) m.camera = looking(View::free, m.camera);
  }
  const bool at_rest = !s.running && !s.steering && m.framed_at != s.revision;
  if (at_rest && m.camera == m.as_framed) m.framed = false;
  if (!m.framed) frame_all(ui, *r.figures, motion_of(s, false), size);
  Picture picture = picture_of(s, ui.question(), ui.residuals(), *r.figures, {m.trails, m.ghosts, m.forces, m.marks});
  picture.ground_height = m.ground;
  r.target->bind();
  r.renderer.draw(picture, m.camera, r.target->width(), r.target->height(), Quality::fast);
  ImGui::InvisibleButton("scene", {size.x, size.y});
  ui.here("scene");
  // The texture's first row is the lowest.
  ImGui::GetWindowDrawList()->AddImageRounded(
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(r.target->texture())), corner,
      {corner.x + size.x, corner.y + size.y}, {0, 1}, {1, 0}, IM_COL32_WHITE, ui.scaled(6));
  note_parts(ui, picture, *r.figures, corner, size);
  const auto hot = draw_places(ui, corner, size, r.pull);
  take_mouse(ui, r.pull, picture, *r.figures, hot, corner, size);
  draw_words(ui, corner, size);
}

}  // namespace spacetime::gui
