#include "symbolic/outline.h"

#include <variant>

#include "symbolic/parse_statement.h"

namespace spacetime::symbolic {
namespace {

template <class What>
std::string name_of(const What& what) {
  if constexpr (requires { what.dof.text; }) {
    return what.dof.text;
  } else if constexpr (requires { what.constant.text; }) {
    return what.constant.text;
  } else if constexpr (requires { what.name.text; }) {
    return what.name.text;
  } else {
    return {};
  }
}

std::string name_of(const Damaged& damaged) {
  if (damaged.statement) return damaged.statement->text;
  return damaged.name ? damaged.name->text : std::string();
}
std::string name_of(const ConstrainDeclaration& constraint) { return constraint.name ? constraint.name->text : ""; }
std::string name_of(const MinimizeDeclaration& term) { return term.name ? term.name->text : ""; }

}  // namespace

std::vector<Outlined> outline(const Scene& scene) {
  std::vector<Outlined> out;
  int constraints = 0, terms = 0;
  for (const Statement& statement : scene.statements) {
    std::string name = std::visit([](const auto& what) { return name_of(what); }, statement.what);
    const bool constrains = statement.word == "constrain", minimizes = statement.word == "minimize";
    constraints += constrains;
    terms += minimizes;
    if (name.empty() && constrains) name = "constraint " + std::to_string(constraints);
    if (name.empty() && minimizes) name = "objective " + std::to_string(terms);
    out.push_back({statement.word, std::move(name), statement.span.line, statement.span.column, statement.begin,
                   statement.end, action_parser(statement.word) != nullptr});
  }
  return out;
}

}  // namespace spacetime::symbolic
