#include "symbolic/server.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>

#include "protocol/action_json.h"
#include "protocol/diagnostics_json.h"
#include "protocol/openrpc.h"
#include "protocol/problem_json.h"
#include "symbolic/compiler.h"
#include "symbolic/query.h"

namespace spacetime::symbolic {
namespace {

using protocol::Call;
using Params = spacetime::Node;  // beside a syntax tree's

void write_statistics(Writer& to, const Statistics& s) {
  to.key("statistics");
  to.object([&] {
    to.member("tree_nodes", s.tree_nodes);
    to.member("shared_nodes", static_cast<int>(s.shared_nodes));
    to.member("operations", static_cast<int>(s.operations));
    to.member("programs", static_cast<int>(s.programs));
    to.member("derived", static_cast<int>(s.derived));
    to.key("milliseconds");
    to.object([&] {
      to.member("parse", s.milliseconds.parse);
      to.member("build", s.milliseconds.build);
      to.member("differentiate", s.milliseconds.differentiate);
      to.member("emit", s.milliseconds.emit);
      to.member("total", s.milliseconds.total);
    });
  });
}

void write_outline(Writer& to, const std::vector<Outlined>& outline) {
  to.key("outline");
  to.list_of(outline, [&](const Outlined& statement) {
    to.object([&] {
      to.member("word", statement.word);
      if (!statement.name.empty()) to.member("name", statement.name);
      to.member("line", statement.line);
      to.member("column", statement.column);
      to.member("begin", static_cast<int>(statement.begin));
      to.member("end", static_cast<int>(statement.end));
      to.member("action", statement.action);
    });
  });
}

// What is wrong with statements that should be one action; nothing where they are.
std::optional<Diagnostic> no_single_action(std::span<const Outlined> found, int lines_before) {
  if (found.size() == 1 && found.front().action) return std::nullopt;
  const std::string expected = "expected an action, such as 'solve', 'iterate 10' or 'set g = 9.81', found ";
  if (found.empty()) return Diagnostic{{lines_before + 1, 1, 1}, expected + "nothing", {}};
  const auto other = std::ranges::find(found, false, &Outlined::action);
  const Outlined& one = other != found.end() ? *other : found[1];
  const Span span{one.line, one.column, static_cast<int>(one.word.size())};
  if (other == found.end()) return Diagnostic{span, "expected one action, found another behind it", {}};
  return Diagnostic{span, expected + "a statement with '" + one.word + "', which belongs into the scene", {}};
}

class Peer {
 public:
  void compile(const Params& params, Writer& result) {
    params.object({"text"}, {"revision"});
    const Compilation compiled = compiler_.compile(params["text"].string());
    if (compiled.problem) {
      result.key("problem");
      write(result, *compiled.problem);
    }
    write_diagnostics(result, compiled.diagnostics);
    write_outline(result, compiled.outline);
    write_statistics(result, compiled.statistics);
  }

  // The action is compiled as the last line of its scene, which has to be without mistakes itself.
  void parse(const Params& params, Writer& result) {
    params.object({"text", "scene"}, {"revision"});
    std::string text = params["scene"].string() + "\n";
    const int lines = static_cast<int>(std::ranges::count(text, '\n'));
    const Compilation before = compiler_.compile(text);
    if (!before.problem) params["scene"].refuse("the scene has mistakes: compile it first");
    text += params["text"].string();
    Compilation after = compiler_.compile(text);
    const auto found = std::ranges::find_if(after.outline, [&](const Outlined& one) { return one.line > lines; });
    if (const auto mistake = no_single_action({found, after.outline.end()}, lines); mistake && after.problem) {
      after.problem.reset();
      after.diagnostics = {*mistake};
    }
    if (after.problem) {
      // What only the action uses is not in the optimizer's problem yet.
      if (after.problem->programs.size() != before.problem->programs.size() ||
          after.problem->constraints.size() != before.problem->constraints.size() ||
          after.problem->objective.size() != before.problem->objective.size()) {
        result.key("problem");
        write(result, *after.problem);
      }
      PlacedAction action = std::move(after.problem->actions.back());
      action.place = {};
      result.key("action");
      write(result, action);
    }
    for (Diagnostic& diagnostic : after.diagnostics) {
      diagnostic.span.line -= lines;
      std::erase_if(diagnostic.notes, [&](const auto& note) { return note.span.line <= lines; });
      for (auto& note : diagnostic.notes) note.span.line -= lines;
    }
    write_diagnostics(result, after.diagnostics);
  }

  void query(const Params& params, Writer& result) {
    params.object({"text", "scene"}, {"by", "revision"});
    const auto scene = understand(params["scene"].string());
    if (!scene->diagnostics.empty()) params["scene"].refuse("the scene has mistakes: compile it first");
    const auto by = params.find("by");
    const Answer answer = symbolic::query(*scene, params["text"].string(), by ? by->string() : std::string());
    if (answer) write_answer(result, *scene, answer);
    write_diagnostics(result, answer.diagnostics);
  }

 private:
  static void write_answer(Writer& result, Understood& scene, const Answer& answer) {
    result.member("name", answer.name);
    result.member("what", answer.what);
    result.member("printed", print_text(read(scene.model, answer.values), names_for(scene, answer)));
    result.key("values");
    result.list_of(answer.values, [&](Expr value) {
      const auto known = scene.model.facts.known(value);
      known&& std::isfinite(*known) ? result.number(*known) : result.null();
    });
    const Sizes sizes = sizes_of(scene, answer.values);
    result.key("counts");
    result.object([&] {
      result.member("tree_nodes", sizes.nodes.tree);
      result.member("shared_nodes", static_cast<int>(sizes.nodes.shared));
      result.member("values", static_cast<int>(sizes.values));
      result.member("jacobian", static_cast<int>(sizes.jacobian));
      result.member("hessian", static_cast<int>(sizes.hessian));
    });
  }

  Compiler compiler_;
};

std::vector<protocol::Method> open(const protocol::Allowance&) {
  const auto peer = std::make_shared<Peer>();
  return {
      {"scene/compile", [peer](const Params& p, Writer& r, Call&) { peer->compile(p, r); }, {}, true},
      {"action/parse", [peer](const Params& p, Writer& r, Call&) { peer->parse(p, r); }, {}},
      {"expression/query", [peer](const Params& p, Writer& r, Call&) { peer->query(p, r); }, {}},
  };
}

}  // namespace

protocol::Service service() {
  return {"spacetime-symbolic", SPACETIME_VERSION, protocol::symbolic_description(), open};
}

}  // namespace spacetime::symbolic
