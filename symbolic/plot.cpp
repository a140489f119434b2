// What can be sampled and drawn by name: every `let`, and what creatures give.
#include <algorithm>

#include "symbolic/expression.h"
#include "symbolic/functional.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

// Plots that share one program.
struct Sheet {
  std::vector<Expr> values;
  std::vector<Plot> plots;

  void add(std::string name, const std::vector<Expr>& components) {
    Plot plot{std::move(name), {}, {}};
    for (const Expr e : components) {
      plot.outputs.push_back(static_cast<int>(values.size()));
      values.push_back(e);
    }
    plots.push_back(std::move(plot));
  }

  // A number made of functionals is no curve, and entering them would make the optimiser carry them along.
  void add_curve(Model& model, std::string name, const std::vector<Expr>& components) {
    const bool number =
        std::any_of(components.begin(), components.end(), [&](Expr e) { return model.facts.has_functional(e); });
    if (!number) add(std::move(name), components);
  }

  void finish(Model& model) {
    if (values.empty()) return;
    const std::string program = add_program(model, values, Derivatives::none);
    for (Plot& plot : plots) {
      plot.program = program;
      model.problem.plots.push_back(std::move(plot));
    }
  }
};

void add_lets(Model& model) {
  Sheet sheet;
  for (const auto& [name, components] : model.lets) sheet.add_curve(model, name, components);
  sheet.finish(model);
}

void add_creature(Model& model, int index) {
  Sheet sheet;
  const Creature& creature = model.creatures[static_cast<std::size_t>(index)];
  const auto add = [&](const std::string& name) {
    sheet.add_curve(model, creature.name + "." + name, creature_member(model, index, -1, name, {}).first.components);
  };
  for (const Point& point : creature.points) add(point.name);
  for (const std::string& link : creature.links) add(link);
  if (has_mass(model, creature)) add("com");
  if (!creature.joints.empty()) {
    add("force");
    const auto& forces = forces_of(model, model.creatures[static_cast<std::size_t>(index)]);
    for (std::size_t i = 0; i < creature.joints.size(); ++i)
      sheet.add_curve(model, creature.name + "." + creature.joints[i].name + ".force", {forces[i]});
  }
  add("kinetic");
  add("potential");
  sheet.finish(model);
}

}  // namespace

void add_plots(Model& model) {
  add_lets(model);
  for (std::size_t i = 0; i < model.creatures.size(); ++i) add_creature(model, static_cast<int>(i));
}

void add_bodies(Model& model) {
  for (Creature& creature : model.creatures) {
    std::vector<Expr> values;
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < creature.links.size(); ++i) {
      const Drawing& drawing = creature.drawings[i];
      if (drawing.shape == Body::Shape::none) continue;
      Body body;
      body.shape = drawing.shape;
      body.name = creature.name + "." + creature.links[i];
      for (const Expr e : drawing.size) body.size.push_back(quantity(model, e));
      const Frame& frame = frames_of(model, creature)[i];
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
          body.outputs.push_back(static_cast<int>(values.size()));
          values.push_back(column < 3 ? frame.rotation[row][column] : frame.position[row]);
        }
      bodies.push_back(std::move(body));
    }
    if (bodies.empty()) continue;
    const std::string program = add_program(model, place(model, values), Derivatives::none);
    for (Body& body : bodies) {
      body.program = program;
      model.problem.bodies.push_back(std::move(body));
    }
  }
}

}  // namespace spacetime::symbolic
