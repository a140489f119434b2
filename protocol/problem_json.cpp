#include "protocol/problem_json.h"

#include <array>

#include "common/fnv.h"
#include "protocol/action_json.h"
#include "protocol/check.h"
#include "protocol/program_json.h"
#include "protocol/quantity_json.h"

namespace spacetime {
namespace {

// Names of enumerations, in their order.
constexpr std::array<std::string_view, 2> functional_kinds{"integral", "at"};
constexpr std::array<std::string_view, 3> piece_kinds{"integral", "at", "once"};
constexpr std::array<std::string_view, 2> relations{"=", "<="};

void write(Writer& to, const Constant& constant) {
  to.object([&] {
    to.member("name", constant.name);
    member(to, "value", constant.value);
    if (constant.frozen) {
      to.key("frozen");
      to.object([&] { write_place(to, *constant.frozen); });
    }
    write_place(to, constant.place);
  });
}

Constant constant_from(const Node& node) {
  node.object({"name", "value"}, {"frozen", "line", "column"});
  Constant constant{node["name"].string(), quantity_from(node["value"]), place_from(node)};
  if (const auto frozen = node.find("frozen")) {
    frozen->object({}, {"line", "column"});
    constant.frozen = place_from(*frozen);
  }
  return constant;
}

void write(Writer& to, const Parameter& parameter) {
  to.object([&] {
    to.member("name", parameter.name);
    member(to, "start", parameter.start);
    member(to, "lower", parameter.lower);
    member(to, "upper", parameter.upper);
    write_place(to, parameter.place);
  });
}

Parameter parameter_from(const Node& node) {
  node.object({"name", "start"}, {"lower", "upper", "line", "column"});
  return {node["name"].string(), quantity_from(node["start"]), place_from(node), optional_quantity(node, "lower"),
          optional_quantity(node, "upper")};
}

void write(Writer& to, const Dof& dof) {
  to.object([&] {
    to.member("name", dof.name);
    to.key("basis");
    write(to, dof.basis);
    member(to, "start", dof.start);
    member(to, "lower", dof.lower);
    member(to, "upper", dof.upper);
    write_place(to, dof.place);
  });
}

Dof dof_from(const Node& node) {
  node.object({"name", "basis", "start"}, {"lower", "upper", "line", "column"});
  return {node["name"].string(), basis_from(node["basis"]),        quantity_from(node["start"]),
          place_from(node),      optional_quantity(node, "lower"), optional_quantity(node, "upper")};
}

// Functionals and pieces are alike: what is summed, and over which time or at which.
template <class Summed>
void write_summed(Writer& to, const Summed& summed, std::span<const std::string_view> kinds) {
  to.object([&] {
    to.choice("kind", kinds, summed.kind);
    to.member("program", summed.program);
    to.member("output", summed.output);
    if (summed.kind == Summed::Kind::at) {
      member(to, "time", summed.from);
    } else {
      member(to, "from", summed.from);
      member(to, "to", summed.to);
    }
  });
}

template <class Summed>
Summed summed_from(const Node& node, std::span<const std::string_view> kinds) {
  Summed summed;
  summed.kind = static_cast<typename Summed::Kind>(node["kind"].choice(kinds));
  if (summed.kind == Summed::Kind::integral) {
    node.object({"kind", "program", "output"}, {"from", "to"});
    summed.from = optional_quantity(node, "from");
    summed.to = optional_quantity(node, "to");
  } else if (summed.kind == Summed::Kind::at) {
    node.object({"kind", "program", "output", "time"});
    summed.from = quantity_from(node["time"]);
  } else {
    node.object({"kind", "program", "output"});
  }
  summed.program = node["program"].string();
  summed.output = node["output"].integer();
  return summed;
}

// When a constraint or a term of the objective takes effect.
template <class Statement>
void write_effect(Writer& to, const Statement& statement) {
  if (statement.since != 0) to.member("since", statement.since);
  if (statement.replacement) to.member("replacement", true);
}

template <class Statement>
void read_effect(const Node& node, Statement& statement) {
  if (const auto since = node.find("since")) statement.since = since->integer();
  if (const auto replacement = node.find("replacement")) statement.replacement = replacement->boolean();
}

void write(Writer& to, const Condition& condition) {
  to.object([&] {
    to.member("program", condition.program);
    to.member("output", condition.output);
  });
}

Condition condition_from(const Node& node) {
  node.object({"program", "output"});
  return {node["program"].string(), node["output"].integer()};
}

void write(Writer& to, const Constraint& constraint) {
  to.object([&] {
    to.member("name", constraint.name);
    to.choice("relation", relations, constraint.relation);
    to.member("program", constraint.program);
    to.key("scope");
    write(to, constraint.scope);
    if (constraint.condition) {
      to.key("condition");
      write(to, *constraint.condition);
    }
    member(to, "weight", constraint.weight);
    write_effect(to, constraint);
    write_place(to, constraint.place);
  });
}

Constraint constraint_from(const Node& node) {
  node.object({"name", "relation", "program", "scope"},
              {"condition", "weight", "since", "replacement", "line", "column"});
  Constraint constraint{node["name"].string(), node["program"].string(), scope_from(node["scope"]),
                        optional_quantity(node, "weight"), place_from(node)};
  constraint.relation = static_cast<Constraint::Relation>(node["relation"].choice(relations));
  if (const auto condition = node.find("condition")) constraint.condition = condition_from(*condition);
  read_effect(node, constraint);
  return constraint;
}

void write(Writer& to, const Term& term) {
  to.object([&] {
    to.member("name", term.name);
    member(to, "weight", term.weight);
    to.key("pieces");
    to.list_of(term.pieces, [&](const Piece& piece) { write_summed(to, piece, piece_kinds); });
    write_effect(to, term);
    write_place(to, term.place);
  });
}

Term term_from(const Node& node) {
  node.object({"name", "weight", "pieces"}, {"since", "replacement", "line", "column"});
  Term term{node["name"].string(), quantity_from(node["weight"]),
            node["pieces"].each([](const Node& piece) { return summed_from<Piece>(piece, piece_kinds); }),
            place_from(node)};
  read_effect(node, term);
  return term;
}

void write(Writer& to, const Keyframe& keyframe) {
  to.object([&] {
    member(to, "time", keyframe.time);
    write_keys(to, keyframe.keys);
    if (keyframe.since != 0) to.member("since", keyframe.since);
    write_place(to, keyframe.place);
  });
}

Keyframe keyframe_from(const Node& node) {
  node.object({"time", "keys"}, {"since", "line", "column"});
  Keyframe keyframe{quantity_from(node["time"]), keys_from(node), place_from(node)};
  if (const auto since = node.find("since")) keyframe.since = since->integer();
  return keyframe;
}

void write(Writer& to, const Plot& plot) {
  to.object([&] {
    to.member("name", plot.name);
    to.member("program", plot.program);
    to.key("outputs");
    to.integers(plot.outputs);
  });
}

Plot plot_from(const Node& node) {
  node.object({"name", "program", "outputs"});
  return {node["name"].string(), node["program"].string(), node["outputs"].integers()};
}

}  // namespace

void write(Writer& to, const Problem& problem) {
  const auto statements = [&](std::string_view name, const auto& list) {
    to.key(name);
    to.list_of(
        list, [&](const auto& statement) { write(to, statement); }, Set::in_lines);
  };
  to.object(
      [&] {
        to.member("format", problem_format);
        to.key("time");
        to.numbers(std::array{problem.start, problem.end});
        statements("constants", problem.constants);
        statements("parameters", problem.parameters);
        statements("dofs", problem.dofs);
        write_programs(to, problem.programs);
        to.key("functionals");
        to.list_of(
            problem.functionals, [&](const Functional& functional) { write_summed(to, functional, functional_kinds); },
            Set::in_lines);
        statements("constraints", problem.constraints);
        statements("objective", problem.objective);
        statements("keyframes", problem.keyframes);
        statements("plots", problem.plots);
        statements("bodies", problem.bodies);
        statements("actions", problem.actions);
      },
      Set::in_lines);
}

std::string write(const Problem& problem) {
  Writer to;
  write(to, problem);
  return to.take();
}

Problem problem_from(const Node& node) {
  static constexpr std::array formats{problem_format};
  node["format"].choice(formats);
  node.object({"format", "time", "constants", "parameters", "dofs", "programs", "functionals", "constraints",
               "objective", "keyframes", "plots", "bodies", "actions"});
  Problem problem;
  const auto time = node["time"];
  if (time.list() != 2) time.expected("a list of 2 numbers");
  problem.start = time[0].number();
  problem.end = time[1].number();
  problem.constants = node["constants"].each(constant_from);
  problem.parameters = node["parameters"].each(parameter_from);
  problem.dofs = node["dofs"].each(dof_from);
  problem.programs = programs_from(node["programs"]);
  problem.functionals = node["functionals"].each(
      [](const Node& functional) { return summed_from<Functional>(functional, functional_kinds); });
  problem.constraints = node["constraints"].each(constraint_from);
  problem.objective = node["objective"].each(term_from);
  problem.keyframes = node["keyframes"].each(keyframe_from);
  problem.plots = node["plots"].each(plot_from);
  problem.bodies = node["bodies"].each(body_from);
  problem.actions = node["actions"].each(action_from);
  return problem;
}

std::string fingerprint(const Problem& problem) {
  Fnv1a sum;
  sum.text(write(problem));
  return sum.digits();
}

Problem read_problem(std::string_view json) {
  const auto tree = parse(json, problem_document);
  auto problem = problem_from({tree, problem_document});
  if (auto fault = validate(problem)) throw DocumentError(problem_document, fault->path, fault->message);
  return problem;
}

}  // namespace spacetime
