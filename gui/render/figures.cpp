#include "gui/render/figures.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/common.hpp>
#include <optional>

#include "common/bspline.h"
#include "common/diagnostic.h"
#include "common/sample.h"
#include "gui/render/palette.h"

namespace spacetime::gui {
namespace {

constexpr float bead = 0.05F;          // m; as large as the scene language's balls
constexpr float rail_distance = 0.3F;  // m, between beads that slide along x
constexpr int motion_samples = 121;    // for the room a motion takes: at most a few hundredths of it are missed

std::string creature_of(const std::string& name) { return name.substr(0, name.find('.')); }

// The axis that a degree of freedom's name speaks of, and what it has in common with its neighbours.
std::optional<std::pair<int, std::string>> coordinate(const std::string& name) {
  const auto axis = [](char c) {
    return static_cast<int>(std::string("xyz").find(static_cast<char>(std::tolower(c))));
  };
  const auto is_axis = [](char c) { return std::string("xyzXYZ").find(c) != std::string::npos; };
  if (is_axis(name.back())) return std::pair{axis(name.back()), name.substr(0, name.size() - 1)};
  const bool numbered = std::all_of(name.begin() + 1, name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  if (is_axis(name.front()) && numbered) return std::pair{axis(name.front()), name.substr(1)};
  return std::nullopt;
}

const Trajectory* find_dof(const Motion& motion, const std::string& name) {
  const auto found = std::ranges::find(motion.dofs, name, &Trajectory::name);
  return found == motion.dofs.end() ? nullptr : &*found;
}

glm::vec3 vector_of(const std::vector<double>& row) {
  glm::vec3 result{0};
  for (std::size_t k = 0; k < std::min<std::size_t>(3, row.size()); ++k)
    result[static_cast<int>(k)] = static_cast<float>(row[k]);
  return result;
}

}  // namespace

Figures::Figures(const Problem& problem) : bodies_(problem.bodies), programs_(problem.programs) {
  const auto takes_functionals = [&](const std::string& program) {
    const auto& inputs = programs_.at(program).inputs;
    return std::ranges::find(inputs, InputKind::functional, &Input::kind) != inputs.end();
  };
  std::erase_if(bodies_, [&](const Body& body) { return takes_functionals(body.program); });
  for (const Plot& plot : problem.plots) {
    const bool spatial = plot.outputs.size() == 2 || plot.outputs.size() == 3;
    const bool force = plot.name.ends_with(".force");  // one number a degree of freedom: no place
    if (spatial && !force && !takes_functionals(plot.program)) plots_.push_back(plot);
  }
  add_bodies();
  std::vector<std::string> dofs;
  for (const Dof& dof : problem.dofs) dofs.push_back(dof.name);
  add_beads(dofs);
}

Figures::Figures(const Motion& motion) : bodies_(motion.bodies), programs_(motion.programs) {
  add_bodies();
  std::vector<std::string> dofs;
  for (const Trajectory& dof : motion.dofs) dofs.push_back(dof.name);
  add_beads(dofs);
}

int Figures::series_of(const std::string& name) {
  return series_.emplace(creature_of(name), static_cast<int>(series_.size())).first->second;
}

void Figures::add_bodies() {
  std::map<int, int> ranks;
  for (const Body& body : bodies_) {
    if (body.shape == Body::Shape::none) continue;
    const int series = series_of(body.name);
    parts_.push_back({body.name, series, ranks[series]++, &body});
  }
  for (const auto& [key, program] : programs_) {
    const auto needs = [&](const auto& each) { return each.program == key; };
    if (std::ranges::any_of(bodies_, needs) || std::ranges::any_of(plots_, needs)) evaluators_.emplace(key, program);
  }
}

void Figures::add_beads(const std::vector<std::string>& dofs) {
  std::map<std::string, std::size_t> places;  // parts by what their names have in common
  std::vector<std::string> others;
  for (const std::string& dof : dofs) {
    if (dof.find('.') != std::string::npos) continue;  // a creature's
    const auto found = coordinate(dof);
    if (!found) {
      others.push_back(dof);
      continue;
    }
    const auto& [axis, common] = *found;
    const auto [place, is_new] = places.emplace(common, parts_.size());
    if (is_new) parts_.push_back({dof, series_of(dof), 0});
    Part& part = parts_[place->second];
    if (!is_new) part.name += "," + dof;
    part.dofs[static_cast<std::size_t>(axis)] = dof;
  }
  if (!parts_.empty()) return;
  for (const std::string& dof : others) {
    parts_.push_back({dof, series_of(dof), 0, nullptr, {dof}, rail_distance * static_cast<float>(parts_.size())});
  }
}

Colour Figures::colour(int id, Theme theme) const {
  const Part& part = parts_.at(id);
  const Colour own = series_colour(theme, part.series);
  return part.rank % 2 == 0 ? own : mix(own, {1, 1, 1}, 0.16F);  // neighbouring links can be told apart
}

std::vector<std::vector<glm::mat4>> Figures::poses(const Motion& motion, std::span<const double> times) const {
  std::vector<std::vector<glm::mat4>> result(times.size(), std::vector<glm::mat4>(parts_.size(), glm::mat4(1)));
  std::map<std::string, Rows> rows;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    if (part.body != nullptr) {
      auto found = rows.find(part.body->program);
      if (found == rows.end()) {
        const auto& key = part.body->program;
        found = rows.emplace(key, along(programs_.at(key), evaluator(key), motion, {}, times)).first;
      }
      for (std::size_t i = 0; i < times.size(); ++i) {
        for (int k = 0; k < 12; ++k)
          result[i][p][k % 4][k / 4] = static_cast<float>(found->second(part.body->outputs[k], i));
      }
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const Trajectory* dof = find_dof(motion, part.dofs[static_cast<std::size_t>(axis)]);
      for (std::size_t i = 0; i < times.size(); ++i) {
        if (dof != nullptr) result[i][p][3][axis] = static_cast<float>(value(dof->basis, dof->coefficients, times[i]));
      }
    }
    for (auto& row : result) row[p][3].z -= part.behind;
  }
  return result;
}

double Figures::number(const Motion& motion, const Quantity& quantity) const {
  if (quantity.program.empty()) return quantity.number;
  const Program& program = programs_.at(quantity.program);
  std::vector<double> inputs;
  for (const Input& input : program.inputs) {
    const auto found = std::ranges::find_if(motion.constants, [&](const auto& c) { return c.first == input.name; });
    inputs.push_back(found == motion.constants.end() ? 0 : found->second);
  }
  return evaluate_once(program, Depth::values, inputs)[quantity.output];
}

Solid Figures::solid(const Motion& motion, std::size_t p, const glm::mat4& pose, Theme theme) const {
  const Part& part = parts_[p];
  Solid solid{.radius = bead, .pose = pose, .colour = colour(static_cast<int>(p), theme), .id = static_cast<int>(p)};
  if (part.body == nullptr) return solid;
  std::vector<float> size;
  for (const Quantity& q : part.body->size) size.push_back(static_cast<float>(number(motion, q)));
  switch (part.body->shape) {
    case Body::Shape::capsule:
      solid.shape = Solid::Shape::capsule;
      solid.radius = size[0];
      solid.extent = {size[1], size[2], size[3]};
      break;
    case Body::Shape::box:
      solid.shape = Solid::Shape::box;
      solid.extent = {size[0], size[1], size[2]};
      break;
    case Body::Shape::sphere:
      solid.radius = size[0];
      break;
    case Body::Shape::none:
      break;
  }
  return solid;
}

std::vector<Solid> Figures::solids(const Motion& motion, double time, Theme theme) const {
  const auto pose = poses(motion, std::span(&time, 1)).front();
  std::vector<Solid> result;
  for (std::size_t p = 0; p < parts_.size(); ++p) result.push_back(solid(motion, p, pose[p], theme));
  return result;
}

std::vector<Solid> Figures::ghosts(const Motion& motion, std::span<const double> times, Theme theme,
                                   float faintest) const {
  const auto all = poses(motion, times);
  std::vector<Solid> result;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const float share = times.size() > 1 ? static_cast<float>(i) / static_cast<float>(times.size() - 1) : 1;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      result.push_back(solid(motion, p, all[i][p], theme));
      result.back().layer = static_cast<int>(i) + 1;
      result.back().opacity = faintest + (1 - faintest) * share;
    }
  }
  return result;
}

std::vector<std::string> Figures::points() const {
  std::vector<std::string> names;
  for (const Part& part : parts_) names.push_back(part.name);
  for (const auto& [creature, series] : series_) names.push_back(creature);
  for (const Plot& plot : plots_) names.push_back(plot.name);
  std::ranges::sort(names);
  const auto repeated = std::ranges::unique(names);
  names.erase(repeated.begin(), repeated.end());
  return names;
}

std::vector<glm::vec3> Figures::way(const Motion& motion, const std::string& point,
                                    std::span<const double> times) const {
  std::vector<glm::vec3> result;
  if (const auto plot = std::ranges::find(plots_, point, &Plot::name); plot != plots_.end()) {
    const Rows rows = along(programs_.at(plot->program), evaluator(plot->program), motion, {}, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      std::vector<double> row;
      for (const int output : plot->outputs) row.push_back(rows(output, i));
      result.push_back(vector_of(row));
    }
    return result;
  }
  const auto is_it = [&](const Part& part) { return part.name == point || creature_of(part.name) == point; };
  if (const auto last = std::find_if(parts_.rbegin(), parts_.rend(), is_it); last != parts_.rend()) {
    const auto p = static_cast<std::size_t>(parts_.rend() - last) - 1;
    for (const auto& row : poses(motion, times)) result.emplace_back(row[p][3]);
    return result;
  }
  if (motion.samples) {
    const auto sampled = motion.samples->values.find(point);
    if (sampled != motion.samples->values.end() && !sampled->second.empty()) {
      for (const double t : times) result.push_back(vector_of(between(*motion.samples, sampled->second, t)));
      return result;
    }
  }
  std::string known;
  for (const std::string& name : points()) known += (known.empty() ? "" : ", ") + name;
  throw InputError("there is no point '" + point + "' to follow; there are " + known);
}

Colour Figures::colour_of_point(const std::string& point, Theme theme) const {
  const auto found = series_.find(creature_of(point));
  return series_colour(theme, found == series_.end() ? static_cast<int>(series_.size()) : found->second);
}

Box Figures::bounds(const Motion& motion) const {
  Box box;
  for (const auto& row : poses(motion, even_times(motion.start, motion.end, motion_samples))) {
    for (std::size_t p = 0; p < parts_.size(); ++p) box.include(gui::bounds(solid(motion, p, row[p], Theme::light)));
  }
  return box;
}

// A foot's capsule reaches through the ground by its radius: what is lower by less than a twelfth stands on it.
float ground_height(const Box& bounds) {
  if (bounds.empty()) return 0;
  return -bounds.low.y < bounds.size().y / 12 ? 0.0F : bounds.low.y;
}

bool planar(const Box& bounds) { return bounds.size().z < 0.25F * std::max(bounds.size().x, bounds.size().y); }

}  // namespace spacetime::gui
