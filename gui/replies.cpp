#include "gui/replies.h"

#include <algorithm>
#include <limits>

#include "gui/words.h"
#include "protocol/check.h"
#include "protocol/motion_json.h"
#include "protocol/problem_json.h"
#include "protocol/program_json.h"
#include "protocol/strict.h"

namespace spacetime::gui {
namespace {

constexpr std::string_view document = "answer";

// Records of a run nobody looks at are thinned beyond so many.
constexpr std::size_t most_records = 20'000;

template <class Value>
Value checked(Value value) {
  if (const auto fault = validate(value)) throw DocumentError(document, fault->path, fault->message);
  return value;
}

Span span_from(const Node& node) {
  return {node["line"].integer(), node["column"].integer(), node["length"].integer()};
}

std::vector<Diagnostic> diagnostics_from(const Node& node) {
  return node.each([](const Node& one) {
    Diagnostic diagnostic{span_from(one), one["message"].string(), {}};
    if (const auto notes = one.find("notes")) {
      diagnostic.notes = notes->each([](const Node& note) {
        return Diagnostic::Note{span_from(note), note["message"].string()};
      });
    }
    return diagnostic;
  });
}

std::vector<Statement> outline_from(const Node& node, const std::string& text) {
  const int length = static_cast<int>(text.size());
  return node.each([&](const Node& one) {
    Statement statement;
    statement.word = one["word"].string();
    if (const auto name = one.find("name")) statement.name = name->string();
    statement.line = one["line"].integer(1);
    statement.column = one["column"].integer(1);
    statement.begin = static_cast<std::size_t>(one["begin"].integer(0, length));
    statement.end = static_cast<std::size_t>(one["end"].integer(static_cast<int>(statement.begin), length));
    statement.action = one["action"].boolean();
    statement.text = text.substr(statement.begin, statement.end - statement.begin);
    return statement;
  });
}

double measure(const Node& node) { return node.is_null() ? std::numeric_limits<double>::quiet_NaN() : node.number(); }

std::vector<Logged> log_from(const Node& node) {
  return node.each([](const Node& action) {
    std::string text = action.json().dump();
    std::string line = iterating_line(text);
    return Logged{std::move(text), std::move(line)};
  });
}

std::map<std::string, std::vector<std::vector<double>>> tables_from(const Node& node) {
  std::map<std::string, std::vector<std::vector<double>>> tables;
  node.members([&](const std::string& name, const Node& rows) {
    tables[name] = rows.each([](const Node& row) { return row.each(measure); });
  });
  return tables;
}

}  // namespace

Compiled compiled_from(int number, const std::string& text, const Json& result) {
  const Node node(result, document);
  auto scene = std::make_shared<Scene>();
  scene->text = text;
  scene->diagnostics = diagnostics_from(node["diagnostics"]);
  scene->outline = outline_from(node["outline"], text);
  if (const auto problem = node.find("problem")) {
    scene->problem = std::make_shared<const Problem>(checked(problem_from(*problem)));
  }
  return {number, scene};
}

Iterated iterated_from(int number, const Json& value) {
  const Node node(value, document);
  Iterated event;
  event.number = number;
  event.records = node["record"].each(record_from);
  event.changed = node["dofs"].each([](const Node& dof) {
    Trajectory trajectory;
    trajectory.name = dof["name"].string();
    if (const auto basis = dof.find("basis")) trajectory.basis = basis_from(*basis);
    trajectory.coefficients = dof["coefficients"].numbers();
    return trajectory;
  });
  if (const auto parameters = node.find("parameters")) {
    parameters->members([&](const std::string& name, const Node& number_node) {
      event.parameters.emplace_back(name, number_node.number());
    });
  }
  return event;
}

void merge(Iterated& earlier, Iterated later) {
  if (earlier.records.size() < most_records || later.records.empty()) {
    earlier.records.insert(earlier.records.end(), later.records.begin(), later.records.end());
  } else {
    earlier.records.back() = later.records.back();
  }
  for (Trajectory& changed : later.changed) {
    const auto found = std::ranges::find(earlier.changed, changed.name, &Trajectory::name);
    if (found == earlier.changed.end()) {
      earlier.changed.push_back(std::move(changed));
    } else {
      if (!changed.basis.knots.empty()) found->basis = std::move(changed.basis);
      found->coefficients = std::move(changed.coefficients);
    }
  }
  earlier.parameters = std::move(later.parameters);
}

Done done_from(int number, const Json& result) {
  const Node node(result, document);
  Done done;
  done.number = number;
  done.log = log_from(node["log"]);
  if (const auto status = node.find("status")) {
    static constexpr std::array<std::string_view, 4> names{"converged", "stopped", "infeasible", "failed"};
    done.run = true;
    done.status = static_cast<Status>(status->choice(names));
    done.message = node["message"].string();
  }
  return done;
}

Reached reached_from(int number, const Json& result, bool checkpoint) {
  const Node node(result, document);
  Reached reached;
  reached.number = number;
  reached.motion = std::make_shared<const Motion>(checked(motion_from(node["motion"])));
  if (const auto log = node.find("log")) reached.log = log_from(*log);
  if (checkpoint) reached.checkpoint = std::make_shared<const std::string>(node["motion"].json().dump());
  return reached;
}

Sampled sampled_from(int number, const Json& result) {
  const Node node(result, document);
  Samples samples;
  samples.times = node["times"].numbers();
  samples.values = tables_from(node["values"]);
  samples.poses = tables_from(node["poses"]);
  for (const auto* tables : {&samples.values, &samples.poses}) {
    for (const auto& [name, rows] : *tables) {
      if (rows.size() != samples.times.size())
        throw DocumentError(document, "/" + name, "expected a row for each time");
    }
  }
  return {number, std::make_shared<const Samples>(std::move(samples))};
}

Answered answered_from(int number, const Json& result) {
  const Node node(result, document);
  Answered answered;
  answered.number = number;
  for (const Diagnostic& diagnostic : diagnostics_from(node["diagnostics"])) {
    answered.text += (answered.text.empty() ? "" : "\n") + diagnostic.message;
    answered.wrong = true;
  }
  if (answered.wrong) return answered;
  answered.text = trimmed(node["printed"].string());
  std::string values;
  for (const auto& value : node["values"].json()) {
    if (value.is_number()) values += (values.empty() ? "" : ", ") + number_text(value.get<double>());
  }
  if (!values.empty()) answered.text += "\nis now " + values;
  const Node counts = node["counts"];
  const auto count = [&](std::string_view name) { return number_text(counts[name].number()); };
  answered.text += "\n" + count("shared_nodes") + " nodes shared, " + count("tree_nodes") + " as a tree; " +
                   count("values") + " operations, " + count("jacobian") + " with first derivatives, " +
                   count("hessian") + " with second";
  return answered;
}

}  // namespace spacetime::gui
