#include "gui/views/grip.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gui/holds.h"
#include "gui/inverse_kinematics.h"
#include "gui/scene_picture.h"
#include "gui/views/constants.h"

namespace spacetime::gui {
namespace {

glm::vec2 as_vector(const ImVec2& v) { return {v.x, v.y}; }

// Where a ray meets the plane through `point` that faces the camera.
std::optional<glm::vec3> meet(const Ray& ray, const glm::vec3& point, const Camera& camera) {
  const glm::vec3 normal = glm::normalize(camera.target - eye(camera));
  const float along = glm::dot(ray.direction, normal);
  if (along < 1e-4F) return std::nullopt;
  return ray.origin + ray.direction * (glm::dot(point - ray.origin, normal) / along);
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

const Body& body_at(const Problem& problem, int index) { return problem.bodies[static_cast<std::size_t>(index)]; }

// The index of a body; -1 for none, and for a bead, which has none.
int index_of(const Problem& problem, const std::string& name) {
  const auto body = std::ranges::find(problem.bodies, name, &Body::name);
  return body == problem.bodies.end() ? -1 : static_cast<int>(body - problem.bodies.begin());
}

// A point of the world in the axes of a body.
glm::dvec3 in_axes(const BodyPose& pose, const Moment& moment, const glm::dvec3& point) {
  const glm::dvec3 origin = pose.place(moment, glm::dvec3(0));
  glm::dvec3 out;
  for (int k = 0; k < 3; ++k) {  // rows of the rotation are what unit vectors become
    glm::dvec3 unit(0);
    unit[k] = 1;
    out[k] = glm::dot(pose.place(moment, unit) - origin, point - origin);
  }
  return out;
}

// What the mouse would take hold of: of what is held, that which holds it, since the two cannot part.
struct Grip {
  int body = -1;  // of the problem
  std::vector<Hold> holds{};
};

Grip grip_at(const Ui& ui, const Picture& picture, const Figures& figures, const Ray& ray) {
  const Problem& problem = *ui.state.scene->problem;
  const int id = pick(picture, ray);
  Grip grip{id < 0 ? -1 : index_of(problem, figures.name(id))};
  if (grip.body < 0) return grip;
  std::string name = figures.name(id);
  const auto holds = holds_at(ui.question(), problem, *ui.state.curves, figures, picture, ui.state.playback.time);
  if (const auto hold = std::ranges::find(holds, name, &Hold::held); hold != holds.end()) name = hold->holder;
  grip.body = index_of(problem, name);
  for (const Hold& hold : holds)
    if (creature_of(hold.holder) == creature_of(name)) grip.holds.push_back(hold);
  return grip;
}

// Of a creature that is drawn as one body, its name is enough.
std::string spoken(const Figures& figures, const std::string& body) {
  int parts = 0;
  for (std::size_t id = 0; id < figures.size(); ++id)
    parts += creature_of(figures.name(static_cast<int>(id))) == creature_of(body) ? 1 : 0;
  return parts == 1 ? creature_of(body) : body;
}

std::string told_of(const Ui& ui, const Figures& figures, const Grip& grip) {
  const Body& body = body_at(*ui.state.scene->problem, grip.body);
  std::string text = spoken(figures, body.name);
  for (const Hold& hold : grip.holds) text += ", and " + spoken(figures, hold.held) + " with it";
  return movable(ui, body).empty() ? text + ": the window leaves it where it is" : text;
}

void draw_pointed(Ui& ui, const ImVec2& corner, const glm::vec2& size) {
  const std::string& text = ui.memory.scene.pointed;
  const ImVec2 mouse = ImGui::GetIO().MousePos, extent = ImGui::CalcTextSize(text.c_str());
  const float away = ui.scaled(16);
  const float x = std::min(mouse.x + away, corner.x + size.x - extent.x - 10);
  const float y = mouse.y + away + extent.y + 6 < corner.y + size.y ? mouse.y + away : mouse.y - away - extent.y;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({x - 5, y - 2}, {x + extent.x + 5, y + extent.y + 2}, packed(ui.colours().raised, 0.92F), 4);
  list.AddText({x, y}, packed(ui.colours().text), text.c_str());
}

// What is held comes along: it stays where it is in the axes of what holds it.
void pull_body(Ui& ui, const Pull& pull, const glm::vec3& target) {
  const Problem& problem = *ui.state.scene->problem;
  if (static_cast<std::size_t>(pull.body) >= problem.bodies.size()) return;  // another scene has come meanwhile
  std::map<std::string, std::pair<double, double>> bounds;
  for (const Freedom& dof : ui.question().dofs)
    if (dof.lower || dof.upper) bounds[dof.name] = {dof.lower.value_or(-1e300), dof.upper.value_or(1e300)};
  Moment moment = shown_moment(ui);
  Pose pose = ui.state.pose.value_or(Pose{});
  const auto follow = [&](int index, const glm::dvec3& point, const glm::dvec3& to) {
    const Body& body = body_at(problem, index);
    const std::vector<std::string> free = movable(ui, body);
    moment.dofs = reach(problem, body, moment, point, to, free, bounds);
    for (const std::string& name : free) pose.values[name] = moment.dofs.at(name);
    return !free.empty();
  };
  if (!follow(pull.body, pull.point, glm::dvec3(target))) return;
  for (const Pull::Carried& one : pull.carried)
    follow(one.body, glm::dvec3(0), BodyPose(problem, body_at(problem, one.by)).place(moment, one.place));
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

// By the point under the mouse: where the ray comes nearest to its origin's depth is good enough.
void take_hold(Ui& ui, Pull& pull, const Grip& grip, const Ray& ray) {
  const Problem& problem = *ui.state.scene->problem;
  const Moment moment = shown_moment(ui);
  const BodyPose pose(problem, body_at(problem, grip.body));
  const auto hit = meet(ray, glm::vec3(pose.place(moment, glm::dvec3(0))), ui.memory.scene.camera);
  if (!hit) return;
  pull.what = Pull::What::body;
  pull.body = grip.body;
  pull.point = in_axes(pose, moment, glm::dvec3(*hit));
  pull.start = *hit;
  for (const Hold& hold : grip.holds) {
    const int body = index_of(problem, hold.held), by = index_of(problem, hold.holder);
    if (body < 0 || by < 0) continue;
    const glm::dvec3 origin = BodyPose(problem, body_at(problem, body)).place(moment, glm::dvec3(0));
    pull.carried.push_back({body, by, in_axes(BodyPose(problem, body_at(problem, by)), moment, origin)});
  }
}

}  // namespace

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
    const Grip grip = grip_at(ui, picture, figures, ray);
    if (hot) {
      pull.what = Pull::What::place;
      pull.place = *hot;
      pull.start = glm::vec3(at(*hot, ui.question().constants));
    } else if (grip.body >= 0) {
      take_hold(ui, pull, grip, ray);
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
  ui.memory.scene.pointed.clear();
  if (!ImGui::IsItemHovered() || ImGui::IsItemActive() || ImGui::IsAnyMouseDown() || hot) return;
  if (const Grip grip = grip_at(ui, picture, figures, ray); grip.body >= 0) {
    ui.memory.scene.pointed = told_of(ui, figures, grip);
    draw_pointed(ui, corner, size);
  }
}

}  // namespace spacetime::gui
