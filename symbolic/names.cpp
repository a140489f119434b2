#include "symbolic/names.h"

#include "common/nearest.h"
#include "symbolic/eliminate.h"
#include "symbolic/functions.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

std::string at_line(const Span& span) { return " (line " + std::to_string(span.line) + ")"; }

void unknown(Model& model, const std::string& name, const Span& span) {
  const auto later = model.later.find(name);
  if (later != model.later.end())
    return report(
        model, span,
        quoted(name) + " is used before it is declared" + at_line(later->second) + ": move its declaration up");
  report(model, span,
         "unknown name " + quoted(name) +
             suggestion(name, known_names(model), "declare it first, for example with 'constant' or 'let'"));
}

template <class T>
std::optional<Name> declared_name(const T& declaration) {
  if constexpr (requires {
                  declaration.name;
                  declaration.name.text.size();
                })
    return declaration.name;
  else
    return std::nullopt;
}

}  // namespace

bool is_too_long(Model& model, const Name& name) {
  if (name.text.size() <= longest_name) return false;
  report(model, name.span, "a name has at most " + std::to_string(longest_name) + " characters");
  return true;
}

bool is_reserved(std::string_view name) {
  return name == "pi" || name == "e" || name == "t" || name == "inf" || name == "and" || name == "or" ||
         name == "not" || function_named(name) != nullptr;
}

void declare(Model& model, const Name& name, Symbol symbol) {
  symbol.span = name.span;
  if (name.text.empty() || is_too_long(model, name)) return;
  if (is_reserved(name.text)) {
    if (symbol.declared) report(model, name.span, quoted(name.text) + " is reserved: choose another name");
    return;
  }
  const auto [it, fresh] = model.symbols.try_emplace(name.text, symbol);
  if (fresh) return;
  if (!it->second.declared) {
    it->second = symbol;
    return;
  }
  if (symbol.declared)
    report(model, name.span, quoted(name.text) + " is declared twice: choose another name",
           {{it->second.span, "it is declared first here"}});
}

Value look_up(Model& model, const std::string& name, const Span& span) {
  if (model.arguments)
    if (const auto argument = model.arguments->find(name); argument != model.arguments->end()) return argument->second;
  if (name == "pi") return {Value::Kind::numbers, {model.graph.pi()}};
  if (name == "e") return {Value::Kind::numbers, {model.graph.number(2.718281828459045)}};
  if (name == "t") return {Value::Kind::numbers, {model.graph.input({InputKind::time, {}, 0, 0})}};
  if (name == "inf") return report(model, span, "'inf' can stand only as a weight, to make a constraint hard"), Value{};
  if (const auto* function = function_named(name))
    return report(model, span, quoted(name) + " is a function: write " + std::string(function->usage)), Value{};
  const auto it = model.symbols.find(name);
  if (it != model.symbols.end() && it->second.kind == Symbol::Kind::function) {
    report(model, span, quoted(name) + " is a function: write " + name + "( )");
    return {};
  }
  if (it != model.symbols.end()) return it->second.value;
  unknown(model, name, span);
  Symbol lost;
  lost.declared = false;
  declare(model, {name, span}, lost);
  return {};
}

std::string statement_name(Model& model, const std::optional<Name>& name, std::string_view kind, int order,
                           const Named& named) {
  if (!name || is_too_long(model, *name)) return std::string(kind) + " " + std::to_string(order);
  if (is_reserved(name->text)) report(model, name->span, quoted(name->text) + " is reserved: choose another name");
  const auto [it, fresh] = model.statement_names.try_emplace(name->text, named);
  if (!fresh && !it->second.lost)
    report(model, name->span, quoted(name->text) + " names two statements: choose another name",
           {{it->second.span, "it is used first here"}});
  return name->text;
}

Named* named_statement(Model& model, const Name& name, bool constraints_only) {
  const auto found = model.statement_names.find(name.text);
  const std::string kind = constraints_only ? "constraint" : "constraint or objective term";
  if (found == model.statement_names.end()) {
    std::vector<std::string> names;
    for (const auto& [known, named] : model.statement_names)
      if (named.is_constraint || !constraints_only) names.push_back(known);
    report(model, name.span,
           "there is no " + kind + " " + quoted(name.text) + " so far" +
               suggestion(name.text, names, "write its name and ':' where it is stated"));
    return nullptr;
  }
  Named& named = found->second;
  if (named.lost) return nullptr;
  if (named.deleted) {
    report(model, name.span, quoted(name.text) + " has been deleted" + at_line(*named.deleted),
           {{*named.deleted, "it is deleted here"}});
    return nullptr;
  }
  if (constraints_only && !named.is_constraint) {
    report(model, name.span, quoted(name.text) + " is an objective term, which has no scope",
           {{named.span, "it is declared here"}});
    return nullptr;
  }
  return &named;
}

std::vector<std::string> known_names(const Model& model) {
  std::vector<std::string> out{"pi", "e", "t"};
  for (const auto& [name, symbol] : model.symbols)
    if (symbol.declared) out.push_back(name);
  for (const Creature& creature : model.creatures)
    for (const std::string& member : member_names(creature)) out.push_back(creature.name + "." + member);
  return out;
}

std::vector<int> dofs_of(Model& model, const std::vector<Name>& names) {
  std::vector<int> out;
  for (const Name& name : names) {
    const auto dof = model.dof_index.find(name.text);
    const auto symbol = model.symbols.find(name.text);
    if (is_eliminated(model, name.text, name.span)) continue;
    if (dof != model.dof_index.end()) {
      out.push_back(dof->second);
    } else if (symbol != model.symbols.end() && symbol->second.kind == Symbol::Kind::creature) {
      for (const Joint& joint : model.creatures[static_cast<std::size_t>(symbol->second.value.creature)].joints)
        if (!model.eliminated.contains(model.creatures[static_cast<std::size_t>(symbol->second.value.creature)].name +
                                       "." + joint.name))
          out.push_back(joint.dof);
    } else if (symbol == model.symbols.end() || symbol->second.kind != Symbol::Kind::lost) {
      std::vector<std::string> dofs;
      for (const auto& [known, index] : model.dof_index) dofs.push_back(known);
      report(model, name.span,
             "there is no degree of freedom " + quoted(name.text) + " so far" +
                 suggestion(name.text, dofs, "declare it first, with 'dof' or as a joint"));
    }
  }
  return out;
}

std::vector<std::string> dof_names_of(Model& model, const std::vector<Name>& names) {
  std::vector<std::string> out;
  std::set<int> seen;
  for (const int dof : dofs_of(model, names))
    if (seen.insert(dof).second) out.push_back(model.problem.dofs[static_cast<std::size_t>(dof)].name);
  return out;
}

void note_declarations(Model& model) {
  for (const Statement& statement : model.scene.statements) {
    const auto name = std::visit([](const auto& what) { return declared_name(what); }, statement.what);
    const bool declares = !std::holds_alternative<WeightAction>(statement.what) &&
                          !std::holds_alternative<ToggleAction>(statement.what) &&
                          !std::holds_alternative<ReplaceAction>(statement.what) &&
                          !std::holds_alternative<ScopeAction>(statement.what);
    if (name && declares) model.later.try_emplace(name->text, name->span);
  }
}

}  // namespace spacetime::symbolic
