// What a scene has to show, under which names, and how large it is.
#include <algorithm>
#include <cctype>

#include "symbolic/functional.h"
#include "symbolic/names.h"
#include "symbolic/query.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

std::string what_of_let(const Model& model, const std::string& name) {
  return model.eliminated.contains(name) ? "eliminated degree of freedom" : "let";
}

void add_members(Model& model, int index, std::vector<Printable>& out) {
  const Creature& creature = model.creatures[static_cast<std::size_t>(index)];
  const auto add = [&](const std::string& name, std::string what) {
    out.push_back(
        {creature.name + "." + name, std::move(what), creature_member(model, index, -1, name, {}).first.components});
  };
  for (const std::string& link : creature.links) add(link, "link, its frame's position");
  for (const Point& point : creature.points) add(point.name, "point, its position");
  if (has_mass(model, model.creatures[static_cast<std::size_t>(index)])) add("com", "centre of mass");
  if (!creature.joints.empty()) add("force", "forces of all joints");
  for (std::size_t i = 0; i < creature.joints.size(); ++i)
    out.push_back({creature.name + "." + creature.joints[i].name + ".force",
                   "joint's force",
                   {forces_of(model, model.creatures[static_cast<std::size_t>(index)])[i]}});
  add("kinetic", "kinetic energy");
  add("potential", "potential energy");
}

bool is_numbered(std::string_view name, std::string_view prefix) {
  return name.starts_with(prefix) && name.size() > prefix.size() &&
         std::ranges::all_of(name.substr(prefix.size()), [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

std::vector<Printable> printable(Understood& scene) {
  Model& model = scene.model;
  std::vector<Printable> out;
  for (const auto& [name, components] : model.lets) out.push_back({name, what_of_let(model, name), components});
  for (std::size_t i = 0; i < model.creatures.size(); ++i) add_members(model, static_cast<int>(i), out);
  for (const Stated& stated : model.stated) {
    const std::string kind = stated.is_constraint ? "constraint " : "objective ";
    const bool hidden = model.symbols.contains(stated.name) || stated.name.starts_with(kind);
    const std::string name = hidden && !stated.name.starts_with(kind) ? kind + stated.name : stated.name;
    if (Answer answer = query(scene, name)) out.push_back({name, std::move(answer.what), std::move(answer.values)});
  }
  return out;
}

PrintedNames names_for(const Understood& scene, const Answer& answer) {
  const Model& model = scene.model;
  const auto is_taken = [&](const std::string& name) { return model.symbols.contains(name) || is_reserved(name); };
  PrintedNames out{answer.name, "s"};
  if (is_taken(out.whole)) out.whole += "_value";
  for (int i = 2; is_taken(out.whole); ++i) out.whole = answer.name + "_value" + std::to_string(i);
  const auto clashes = [&](const std::string& prefix) {
    return is_numbered(out.whole, prefix) ||
           std::ranges::any_of(model.symbols, [&](const auto& symbol) { return is_numbered(symbol.first, prefix); });
  };
  while (clashes(out.part)) out.part += "_";
  return out;
}

Sizes sizes_of(Understood& scene, const std::vector<Expr>& values) {
  Model& model = scene.model;
  std::vector<Expr> all = values;
  for (const int k : all_functionals_in(model, values))
    all.push_back(model.functionals[static_cast<std::size_t>(k)].integrand);
  Graph own;
  const std::vector<Expr> copied = copy(model.graph, model.fingerprints, all, own);
  Sizes out;
  out.nodes = size_of(own, copied);
  const Program program = emit(own, copied, Derivatives::second);
  out.values = static_cast<std::size_t>(program.value_operations);
  out.jacobian = static_cast<std::size_t>(program.jacobian_operations);
  out.hessian = program.op.size();
  return out;
}

}  // namespace spacetime::symbolic
