#include "protocol/program_json.h"

#include <array>
#include <string_view>

#include "protocol/limits.h"
#include "protocol/quantity_json.h"

namespace spacetime {
namespace {

constexpr std::array<std::string_view, 4> shapes{"capsule", "sphere", "box", "none"};  // in the order of Body::Shape

bool is_named(InputKind kind) {
  return kind == InputKind::dof || kind == InputKind::signal || kind == InputKind::constant ||
         kind == InputKind::parameter;
}
bool is_indexed(InputKind kind) { return kind == InputKind::functional || kind == InputKind::multiplier; }
bool is_derivable(InputKind kind) { return kind == InputKind::dof || kind == InputKind::signal; }

void write_input(Writer& to, const Input& input) {
  to.object([&] {
    to.member("kind", name_of(input.kind));
    if (is_named(input.kind)) to.member("name", input.name);
    if (is_indexed(input.kind)) to.member("index", input.index);
    if (is_derivable(input.kind)) to.member("derivative", input.derivative);
  });
}

Input input_from(const Node& node) {
  const auto kind_node = node["kind"];
  const auto kind = input_kind_named(kind_node.string());
  if (!kind) kind_node.expected("a kind of input (dof, signal, constant, parameter, functional, time, multiplier)");
  Input input;
  input.kind = *kind;
  if (is_derivable(*kind)) {
    node.object({"kind", "name", "derivative"});
    input.derivative = node["derivative"].integer(0, 2);
  } else if (is_named(*kind)) {
    node.object({"kind", "name"});
  } else if (is_indexed(*kind)) {
    node.object({"kind", "index"});
    input.index = node["index"].integer();
  } else {
    node.object({"kind"});
  }
  if (is_named(*kind)) input.name = node["name"].string();
  return input;
}

}  // namespace

void write(Writer& to, const Program& program) {
  to.object(
      [&] {
        to.key("inputs");
        to.list_of(program.inputs, [&](const Input& input) { write_input(to, input); });
        to.key("numbers");
        to.numbers(program.numbers);
        to.key("op");
        to.list_of(program.op, [&](Op op) { to.string(info(op).name); });
        to.key("a");
        to.integers(program.a);
        to.key("b");
        to.integers(program.b);
        to.key("c");
        to.integers(program.c);
        to.key("values");
        to.integers(program.values);
        to.key("jacobian");
        to.list_of(program.jacobian, [&](const JacobianEntry& entry) {
          to.integers(std::array{entry.row, entry.input, entry.value});
        });
        to.key("hessian");
        to.list_of(program.hessian, [&](const HessianEntry& entry) {
          to.integers(std::array{entry.row, entry.column, entry.value});
        });
        to.key("operations");
        to.object([&] {
          to.member("values", program.value_operations);
          to.member("jacobian", program.jacobian_operations);
        });
      },
      Set::in_lines);
}

Program program_from(const Node& node) {
  node.object({"inputs", "numbers", "op", "a", "b", "c", "values", "jacobian", "hessian", "operations"});
  Program program;
  program.inputs = node["inputs"].each(input_from);
  program.numbers = node["numbers"].numbers();
  node["op"].list(limits::operations);
  program.op = node["op"].strings(op_named, "the name of an operation");
  program.a = node["a"].integers();
  program.b = node["b"].integers();
  program.c = node["c"].integers();
  program.values = node["values"].integers();
  for (const auto& [row, input, value] : node["jacobian"].triples()) program.jacobian.push_back({row, input, value});
  for (const auto& [row, column, value] : node["hessian"].triples()) program.hessian.push_back({row, column, value});
  const auto operations = node["operations"];
  operations.object({"values", "jacobian"});
  program.value_operations = operations["values"].integer();
  program.jacobian_operations = operations["jacobian"].integer();
  return program;
}

void write(Writer& to, const Basis& basis) {
  to.object([&] {
    to.member("kind", "bspline");
    to.key("knots");
    to.numbers(basis.knots);
  });
}

Basis basis_from(const Node& node) {
  static constexpr std::array<std::string_view, 1> kinds{"bspline"};
  node.object({"kind", "knots"});
  node["kind"].choice(kinds);
  const auto knots = node["knots"];
  knots.list(limits::spans + 7);
  return {.knots = knots.numbers()};
}

void write_programs(Writer& to, const std::map<std::string, Program>& programs) {
  to.key("programs");
  to.object(
      [&] {
        for (const auto& [name, program] : programs) {
          to.key(name);
          write(to, program);
        }
      },
      Set::in_lines);
}

std::map<std::string, Program> programs_from(const Node& node) {
  std::map<std::string, Program> programs;
  node.members([&](const std::string& name, const Node& program) { programs.emplace(name, program_from(program)); });
  return programs;
}

void write(Writer& to, const Body& body) {
  to.object([&] {
    to.member("name", body.name);
    to.choice("shape", shapes, body.shape);
    member(to, "size", body.size);
    to.member("program", body.program);
    to.key("outputs");
    to.integers(body.outputs);
  });
}

Body body_from(const Node& node) {
  node.object({"name", "shape", "size", "program", "outputs"});
  return {static_cast<Body::Shape>(node["shape"].choice(shapes)), node["name"].string(),
          node["size"].each(quantity_from), node["program"].string(), node["outputs"].integers()};
}

void write(Writer& to, const Trajectory& dof) {
  to.object([&] {
    to.member("name", dof.name);
    to.key("basis");
    write(to, dof.basis);
    to.key("coefficients");
    to.numbers(dof.coefficients);
  });
}

Trajectory trajectory_from(const Node& node) {
  node.object({"name", "basis", "coefficients"});
  return {node["name"].string(), basis_from(node["basis"]), node["coefficients"].numbers()};
}

}  // namespace spacetime
