#include "protocol/checkpoint_json.h"

#include "protocol/action_json.h"
#include "protocol/measure.h"
#include "protocol/program_json.h"

namespace spacetime {
namespace {

void write(const Measures& measures, const Checkpoint::Newton& newton) {
  auto& to = measures.to;
  to.object(
      [&] {
        to.member("mu", newton.mu);
        measures.member("slacks", newton.slacks);
        measures.member("multipliers", newton.multipliers);
        measures.member("lower", newton.lower);
        measures.member("upper", newton.upper);
        to.member("outside", newton.outside);
        to.key("active");
        to.integers(newton.active);
        to.key("switches");
        to.integers(newton.switches);
        to.key("filter");
        to.list_of(newton.filter, [&](const Checkpoint::Newton::Entry& entry) {
          to.list([&] {
            to.number(entry.violation);
            to.number(entry.objective);
          });
        });
        measures.member("filter_limit", newton.filter_limit);
        measures.member("most_violation", newton.most_violation);
        to.member("shift", newton.shift);
        to.member("radius", newton.radius);
        to.member("restore_from", newton.restore_from);
        to.member("damping", newton.damping);
        to.member("curved", newton.curved);
        to.member("least_sum", newton.least_sum);
        to.member("without_progress", newton.without_progress);
        to.key("proposed");
        to.numbers(newton.proposed);
      },
      Set::in_lines);
}

std::vector<double> measures_from(const Node& node) { return node.each(measure_from); }

Checkpoint::Newton newton_from(const Node& node) {
  node.object({"mu", "slacks", "multipliers", "lower", "upper", "outside", "active", "switches", "filter",
               "filter_limit", "most_violation", "shift", "radius", "restore_from", "damping", "curved", "least_sum",
               "without_progress", "proposed"});
  Checkpoint::Newton newton;
  newton.mu = node["mu"].number();
  newton.slacks = measures_from(node["slacks"]);
  newton.multipliers = measures_from(node["multipliers"]);
  newton.lower = measures_from(node["lower"]);
  newton.upper = measures_from(node["upper"]);
  newton.outside = node["outside"].boolean();
  newton.active = node["active"].integers();
  newton.switches = node["switches"].integers();
  newton.filter = node["filter"].each([](const Node& entry) {
    if (entry.list() != 2) entry.expected("a list of 2 numbers");
    return Checkpoint::Newton::Entry{entry[0].number(), entry[1].number()};
  });
  newton.filter_limit = measure_from(node["filter_limit"]);
  newton.most_violation = measure_from(node["most_violation"]);
  newton.shift = node["shift"].number();
  newton.radius = node["radius"].number();
  newton.restore_from = node["restore_from"].number();
  newton.damping = node["damping"].number();
  newton.curved = node["curved"].boolean();
  newton.least_sum = node["least_sum"].number();
  newton.without_progress = node["without_progress"].integer();
  newton.proposed = node["proposed"].numbers();
  return newton;
}

Window window_from(const Node& node) {
  const Action action = action_from(node).action;
  const auto* window = std::get_if<Window>(&action);
  if (!window) node["action"].expected("\"window\"");
  return *window;
}

}  // namespace

void write(Writer& to, const Checkpoint& checkpoint, bool failed) {
  const Measures measures{to, failed};
  to.object(
      [&] {
        to.member("problem", checkpoint.problem);
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

Checkpoint checkpoint_from(const Node& node) {
  node.object({"problem", "declared", "edits", "damping", "shakes", "judged", "functionals", "step", "shift", "pivoted",
               "newton"},
              {"progress", "window", "start", "outside", "sqp92", "bfgs"});
  Checkpoint checkpoint;
  checkpoint.problem = node["problem"].string();
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
    outside->object({"objective", "functionals"});
    checkpoint.outside = {measure_from((*outside)["objective"]), measures_from((*outside)["functionals"])};
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
