#include "protocol/checkpoint_json.h"

#include <algorithm>
#include <array>

#include "common/fnv.h"
#include "protocol/action_json.h"
#include "protocol/measure.h"
#include "protocol/program_json.h"

namespace spacetime {
namespace {

// Newton's state, member by member in the document's order: plain(name, value), or measure(name, value) of what may be
// none where the motion has failed.
template <class Newton, class Plain, class Measure>
void each_member(Newton& newton, const Plain& plain, const Measure& measure) {
  plain("mu", newton.mu);
  measure("slacks", newton.slacks);
  measure("multipliers", newton.multipliers);
  measure("lower", newton.lower);
  measure("upper", newton.upper);
  plain("outside", newton.outside);
  plain("active", newton.active);
  plain("switches", newton.switches);
  plain("filter", newton.filter);
  measure("filter_limit", newton.filter_limit);
  measure("most_violation", newton.most_violation);
  plain("shift", newton.shift);
  plain("radius", newton.radius);
  plain("restore_from", newton.restore_from);
  plain("damping", newton.damping);
  plain("curved", newton.curved);
  plain("least_sum", newton.least_sum);
  plain("without_progress", newton.without_progress);
  plain("proposed", newton.proposed);
}

using Filter = std::vector<Checkpoint::Newton::Entry>;

void put(Writer& to, double value) { to.number(value); }
void put(Writer& to, int value) { to.integer(value); }
void put(Writer& to, bool value) { to.boolean(value); }
void put(Writer& to, const std::vector<double>& values) { to.numbers(values); }
void put(Writer& to, const std::vector<int>& values) { to.integers(values); }
void put(Writer& to, const Filter& filter) {
  to.list_of(filter, [&](const auto& entry) { to.numbers(std::array{entry.violation, entry.objective}); });
}

void take(const Node& from, double& value) { value = from.number(); }
void take(const Node& from, int& value) { value = from.integer(); }
void take(const Node& from, bool& value) { value = from.boolean(); }
void take(const Node& from, std::vector<double>& values) { values = from.numbers(); }
void take(const Node& from, std::vector<int>& values) { values = from.integers(); }
void take(const Node& from, Filter& filter) {
  filter = from.each([](const Node& entry) {
    if (entry.list() != 2) entry.expected("a list of 2 numbers");
    return Checkpoint::Newton::Entry{entry[0].number(), entry[1].number()};
  });
}
void take_measure(const Node& from, double& value) { value = measure_from(from); }
void take_measure(const Node& from, std::vector<double>& values) { values = from.each(measure_from); }

void write(const Measures& measures, const Checkpoint::Newton& newton) {
  const auto plain = [&](std::string_view name, const auto& value) {
    measures.to.key(name);
    put(measures.to, value);
  };
  const auto measure = [&](std::string_view name, const auto& value) { measures.member(name, value); };
  measures.to.object([&] { each_member(newton, plain, measure); }, Set::in_lines);
}

Checkpoint::Newton newton_from(const Node& node) {
  Checkpoint::Newton newton;
  std::vector<std::string_view> names;
  const auto name_of = [&](std::string_view name, const auto&) { names.push_back(name); };
  each_member(newton, name_of, name_of);
  node.object(names, {});
  const auto plain = [&](std::string_view name, auto& value) { take(node[name], value); };
  const auto measure = [&](std::string_view name, auto& value) { take_measure(node[name], value); };
  each_member(newton, plain, measure);
  return newton;
}

Window window_from(const Node& node) {
  const Action action = action_from(node).action;
  const auto* window = std::get_if<Window>(&action);
  if (!window) node["action"].expected("\"window\"");
  return *window;
}

void write(Writer& to, const Checkpoint& checkpoint, bool failed, const std::string& stamp) {
  const Measures measures{to, failed};
  to.object(
      [&] {
        to.member("problem", checkpoint.problem);
        if (!stamp.empty()) to.member("fingerprint", stamp);
        if (const auto& progress = checkpoint.progress) {
          to.key("progress");
          to.object([&] {
            to.member("action", progress->action);
            to.member("iterations", progress->iterations);
          });
        }
        to.member("declared", checkpoint.declared);
        to.key("edits");
        to.list_of(
            checkpoint.edits,
            [&](const Action& edit) {
              write(to, {edit, {}});
            },
            Set::in_lines);
        if (checkpoint.window != Window{}) {
          to.key("window");
          write(to, {checkpoint.window, {}});
        }
        member(to, "damping", checkpoint.damping);
        to.member("shakes", checkpoint.shakes);
        if (const auto& start = checkpoint.start) {
          to.key("start");
          to.object([&] {
            to.key("dofs");
            to.list_of(
                start->dofs, [&](const Trajectory& dof) { write(to, dof); }, Set::in_lines);
            member(to, "parameters", start->parameters);
          });
        }
        to.member("judged", checkpoint.judged);
        to.key("functionals");
        to.numbers(checkpoint.functionals);
        if (const auto& outside = checkpoint.outside) {
          to.key("outside");
          to.object([&] {
            measures.member("objective", outside->objective);
            measures.member("terms", outside->terms);
            measures.member("functionals", outside->functionals);
          });
        }
        to.member("step", checkpoint.step);
        to.member("shift", checkpoint.last_shift);
        to.member("pivoted", checkpoint.pivoted);
        to.key("newton");
        write(measures, checkpoint.newton);
        if (const auto& sqp92 = checkpoint.sqp92) {
          to.key("sqp92");
          to.object([&] {
            to.key("multipliers");
            to.numbers(sqp92->multipliers);
            to.key("weights");
            to.numbers(sqp92->weights);
          });
        }
        if (const auto& bfgs = checkpoint.bfgs) {
          to.key("bfgs");
          to.object([&] {
            to.key("inverse");
            to.numbers(bfgs->inverse);
          });
        }
      },
      Set::in_lines);
}

}  // namespace

void write_checkpoint(Writer& to, const Motion& motion) {
  write(to, *motion.checkpoint, motion.status == Status::failed, fingerprint(motion));
}

std::string fingerprint(const Motion& motion) {
  const auto sorted = [](Named named) {  // members of an object may stand in any order
    std::ranges::sort(named);
    return named;
  };
  Checkpoint checkpoint = *motion.checkpoint;
  checkpoint.damping = sorted(std::move(checkpoint.damping));
  if (auto& start = checkpoint.start) start->parameters = sorted(std::move(start->parameters));
  Writer numbers(false);
  numbers.object([&] {
    numbers.member("iterations", motion.iterations);
    numbers.key("dofs");
    numbers.list_of(motion.dofs, [&](const Trajectory& dof) { write(numbers, dof); });
    member(numbers, "parameters", sorted(motion.parameters));
    numbers.key("checkpoint");
    write(numbers, checkpoint, true, {});
  });
  Fnv1a sum;
  sum.text(numbers.take());
  return sum.digits();
}

Checkpoint checkpoint_from(const Node& node, bool stamped) {
  if (stamped) {
    node["fingerprint"];  // is missing
  } else if (const auto found = node.find("fingerprint")) {
    found->refuse("the format's version 1 has no fingerprint");
  }
  node.object({"problem", "declared", "edits", "damping", "shakes", "judged", "functionals", "step", "shift", "pivoted",
               "newton"},
              {"fingerprint", "progress", "window", "start", "outside", "sqp92", "bfgs"});
  Checkpoint checkpoint;
  checkpoint.problem = node["problem"].string();
  if (stamped) {
    checkpoint.fingerprint = node["fingerprint"].string();
    const bool digits = checkpoint.fingerprint.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (checkpoint.fingerprint.size() != 32 || !digits) node["fingerprint"].expected("32 hexadecimal digits");
  }
  if (const auto progress = node.find("progress")) {
    progress->object({"action", "iterations"});
    checkpoint.progress = {(*progress)["action"].integer(), (*progress)["iterations"].integer()};
  }
  checkpoint.declared = node["declared"].integer();
  checkpoint.edits = node["edits"].each([](const Node& edit) { return action_from(edit).action; });
  if (const auto window = node.find("window")) checkpoint.window = window_from(*window);
  checkpoint.damping = named_numbers(node["damping"]);
  checkpoint.shakes = node["shakes"].integer();
  if (const auto start = node.find("start")) {
    start->object({"dofs", "parameters"});
    checkpoint.start = {(*start)["dofs"].each(trajectory_from), named_numbers((*start)["parameters"])};
  }
  checkpoint.judged = node["judged"].boolean();
  checkpoint.functionals = node["functionals"].numbers();
  if (const auto outside = node.find("outside")) {
    outside->object({"objective", "functionals"}, {"terms"});
    checkpoint.outside = {measure_from((*outside)["objective"]), {}, (*outside)["functionals"].each(measure_from)};
    if (const auto terms = outside->find("terms")) checkpoint.outside->terms = terms->each(measure_from);
  }
  checkpoint.step = node["step"].number();
  checkpoint.last_shift = node["shift"].number();
  checkpoint.pivoted = node["pivoted"].integer();
  checkpoint.newton = newton_from(node["newton"]);
  if (const auto sqp92 = node.find("sqp92")) {
    sqp92->object({"multipliers", "weights"});
    checkpoint.sqp92 = {(*sqp92)["multipliers"].numbers(), (*sqp92)["weights"].numbers()};
  }
  if (const auto bfgs = node.find("bfgs")) {
    bfgs->object({"inverse"});
    checkpoint.bfgs = {(*bfgs)["inverse"].numbers()};
  }
  return checkpoint;
}

}  // namespace spacetime
