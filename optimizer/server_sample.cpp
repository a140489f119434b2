#include "optimizer/server_sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "common/bspline.h"
#include "common/limits.h"
#include "protocol/declared.h"
#include "protocol/measure.h"

namespace spacetime::optimizer {
namespace {

// A degree of freedom or its derivative, by the name that the language has for it: x, x' or x''.
struct Derivative {
  std::string name;
  std::size_t place;  // among the problem's
  int order;
};

Derivative derivative_named(const Node& name, const Problem& problem) {
  std::string_view bare = name.string();
  int order = 0;
  for (; order < 2 && bare.ends_with('\''); ++order) bare.remove_suffix(1);
  const auto found = std::ranges::find(problem.dofs, bare, &Dof::name);
  if (found == problem.dofs.end()) {
    auto names = names_of(problem.plots);
    for (const Body& body : problem.bodies) names.push_back(body.name);
    for (const Dof& dof : problem.dofs) names.push_back(dof.name);
    name.refuse(there_is_no("plotted expression, body or degree of freedom", name.string(), names));
  }
  return {name.string(), static_cast<std::size_t>(found - problem.dofs.begin()), order};
}

// What is worked out for each time.
struct Cost {
  double numbers = 0, operations = 0;
};

Cost cost_of(const Problem& problem, const std::set<std::string>* only) {
  Cost cost;
  std::set<std::string_view> programs;
  const auto add = [&](const auto& things) {
    for (const auto& thing : things) {
      if (only && !only->contains(thing.name)) continue;
      cost.numbers += static_cast<double>(thing.outputs.size());
      if (!programs.insert(thing.program).second) continue;
      cost.operations += static_cast<double>(problem.programs.at(thing.program).op.size());
    }
  };
  add(problem.plots);
  add(problem.bodies);
  return cost;
}

}  // namespace

void answer_sample(const Node& params, const Session& session, const protocol::Allowance& allowance, Writer& result) {
  params.object({"times"}, {"expressions", "revision"});
  const auto times = params["times"].numbers();
  const Problem& problem = session.problem();
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < problem.start || times[i] > problem.end) {
      params["times"][i].refuse(
          fmt::format("{:.9g} is outside the problem's time, {:.9g} to {:.9g}", times[i], problem.start, problem.end));
    }
  }
  std::optional<std::set<std::string>> wanted;
  std::vector<Derivative> dofs;
  if (const auto names = params.find("expressions")) {
    wanted.emplace();
    names->each([&](const Node& name) {
      if (!wanted->insert(name.string()).second) return 0;  // named twice, told once
      const auto is_it = [&](const auto& thing) { return thing.name == name.string(); };
      if (std::ranges::none_of(problem.plots, is_it) && std::ranges::none_of(problem.bodies, is_it)) {
        dofs.push_back(derivative_named(name, problem));
      }
      return 0;
    });
  }
  const std::set<std::string>* only = wanted ? &*wanted : nullptr;
  const Cost each = cost_of(problem, only);
  const double count = static_cast<double>(times.size());
  const double numbers = count * (each.numbers + static_cast<double>(dofs.size()));
  if (numbers > allowance.samples) throw beyond("samples", allowance, numbers);
  if (const double operations = count * each.operations; operations > limits::evaluated_operations) {
    params["times"].refuse(fmt::format("that would run {:.3g} operations, more than {:.3g}: ask for fewer at once",
                                       operations, limits::evaluated_operations));
  }
  Samples samples = session.samples(times, only);
  const auto curves = session.trajectories();
  for (const Derivative& dof : dofs) {
    std::vector<std::vector<double>> rows;
    const Trajectory& curve = curves[dof.place];
    for (const double t : times) rows.push_back({value(curve.basis, curve.coefficients, t, dof.order)});
    samples.values.insert_or_assign(dof.name, std::move(rows));
  }
  const spacetime::Measures measures{result, true};
  const auto write_rows = [&](std::string_view member, const auto& tables) {
    result.key(member);
    result.object([&] {
      for (const auto& [name, rows] : tables) {
        result.key(name);
        result.list_of(rows, [&](const std::vector<double>& row) {
          result.list_of(row, [&](double number) { measures.value(number); });
        });
      }
    });
  };
  result.key("times");
  result.numbers(times);
  write_rows("values", samples.values);
  write_rows("poses", samples.poses);
}

}  // namespace spacetime::optimizer
