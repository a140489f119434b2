#include "protocol/declared.h"

#include <algorithm>
#include <cmath>

#include "common/nearest.h"
#include "protocol/path.h"

namespace spacetime {
void fail(std::string path, std::string message) { throw Fault{std::move(path), std::move(message)}; }

void check_name(std::string_view name, const std::string& path, Names& names) {
  if (auto fault = validate_name(name, path)) throw std::move(*fault);
  if (!names.insert(name).second) fail(path, quoted(name) + " is the name of an earlier one already");
}

std::string quoted(std::string_view name) { return std::string("\"").append(name).append("\""); }

std::string there_is_no(std::string_view what, std::string_view name, std::span<const std::string> present) {
  constexpr std::size_t most = 8;  // names that a sentence lists
  std::string others = present.empty() ? "the problem has none" : "the problem has ";
  for (std::size_t i = 0; i < std::min(present.size(), most); ++i) {
    others += (i == 0 ? "" : i + 1 == present.size() ? " and " : ", ") + quoted(present[i]);
  }
  if (present.size() > most) others += " and " + std::to_string(present.size() - most) + " more";
  return "there is no " + std::string(what) + " " + quoted(name) + suggestion(name, present, others, '"');
}

bool reversed(const Quantity& lower, const Quantity& upper) {
  return lower.program.empty() && upper.program.empty() && lower.number > upper.number;
}

void check_place(const Place& place, const std::string& path) {
  if (place.line < 0) fail(path + "/line", "must not be negative");
  if (place.column < 0) fail(path + "/column", "must not be negative");
}

void check_output(const Needs& needs, int output, const std::string& path) {
  if (output < 0 || static_cast<std::size_t>(output) >= needs.outputs) {
    fail(path, "the program has " + std::to_string(needs.outputs) + " values, numbered from 0; there is no " +
                   std::to_string(output));
  }
}

void check_timeless(const Needs& needs, const std::string& path) {
  if (needs.trajectory || needs.time) {
    fail(path, "what is evaluated once cannot depend on time or on a trajectory");
  }
}

Declared::Declared(const Problem& problem) : problem_(problem) {
  declarations();
  programs();
  statements();
}

void Declared::declarations() {
  Names names;  // shared by all that expressions name
  const auto declare = [&](const auto& list, std::string_view list_path, Places& places) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto path = below(list_path, i);
      check_name(list[i].name, path + "/name", names);
      check_place(list[i].place, path);
      places.emplace(list[i].name, i);
    }
  };
  declare(problem_.constants, "/constants", constants_);
  declare(problem_.parameters, "/parameters", parameters_);
  declare(problem_.dofs, "/dofs", dofs_);
  for (std::size_t i = 0; i < problem_.constants.size(); ++i) {
    const auto& frozen = problem_.constants[i].frozen;
    if (frozen) check_place(*frozen, below("/constants", i) + "/frozen");
  }
  for (std::size_t i = 0; i < problem_.dofs.size(); ++i) {
    const auto& basis = problem_.dofs[i].basis;
    const auto path = below("/dofs", i) + "/basis";
    if (auto fault = validate(basis, problem_.start, problem_.end, path)) throw std::move(*fault);
    most_knots_ = std::max(most_knots_, basis.knots.size() - 6);
  }
}

void Declared::programs() {
  for (const auto& [key, program] : problem_.programs) needs_.emplace(key, needs_of(program, below("/programs", key)));
}

Needs Declared::needs_of(const Program& program, const std::string& path) const {
  Needs needs{.outputs = program.values.size(), .operations = program.op.size()};
  for (std::size_t i = 0; i < program.inputs.size(); ++i) {
    const auto& input = program.inputs[i];
    const auto unknown = [&](const char* kind) {
      fail(below(path + "/inputs", i) + "/name", "there is no " + std::string(kind) + ' ' + quoted(input.name));
    };
    switch (input.kind) {
      case InputKind::dof:
        if (!dofs_.contains(input.name)) unknown("degree of freedom");
        needs.trajectory = true;
        break;
      case InputKind::signal:
        unknown("signal");
        break;
      case InputKind::constant: {
        const auto found = constants_.find(input.name);
        if (found == constants_.end()) unknown("constant");
        needs.constant = std::max(needs.constant, static_cast<std::ptrdiff_t>(found->second));
        break;
      }
      case InputKind::parameter:
        if (!parameters_.contains(input.name)) unknown("parameter");
        needs.parameter = true;
        break;
      case InputKind::functional:
        if (static_cast<std::size_t>(input.index) >= problem_.functionals.size()) {
          fail(below(path + "/inputs", i) + "/index", "there is no functional " + std::to_string(input.index));
        }
        needs.functional = std::max(needs.functional, static_cast<std::ptrdiff_t>(input.index));
        break;
      case InputKind::time:
        needs.time = true;
        break;
      case InputKind::multiplier:
        needs.multiplier = true;
        break;
    }
  }
  return needs;
}

// Constraints and objective terms share one set of names, since actions name either.
void Declared::statements() {
  Names names;
  constraints_ = statements(problem_.constraints, "/constraints", names);
  terms_ = statements(problem_.objective, "/objective", names);
}

void Declared::beginning(int since, const std::string& path) const {
  const std::size_t actions = problem_.actions.size();
  if (since < 0 || static_cast<std::size_t>(since) > actions)
    fail(path + "/since", "must be from 0 to " + std::to_string(actions) + ", the number of actions");
}

template <class Statement>
Declared::Places Declared::statements(const std::vector<Statement>& list, std::string_view list_path,
                                      Names& names) const {
  Places places;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto path = below(list_path, i);
    check_place(list[i].place, path);
    beginning(list[i].since, path);
    if (list[i].replacement) continue;
    check_name(list[i].name, path + "/name", names);
    places.emplace(list[i].name, i);
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].replacement || places.contains(list[i].name)) continue;
    fail(below(list_path, i) + "/name",
         "a replacement bears the name of what it replaces, and there is no " + quoted(list[i].name) + " here");
  }
  return places;
}

const Needs& Declared::program(const std::string& name, const std::string& path) const {
  const auto found = needs_.find(name);
  if (found == needs_.end()) fail(path + "/program", "there is no program " + quoted(name));
  return found->second;
}

void Declared::dof(const std::string& name, const std::string& path) const {
  if (!dofs_.contains(name)) fail(path, there_is_no("degree of freedom", name, names_of(problem_.dofs)));
}

void Declared::quantity(const Quantity& quantity, const std::string& path, std::size_t known) const {
  if (quantity.program.empty()) {
    if (!std::isfinite(quantity.number)) fail(path, "must be finite");
    return;
  }
  const auto& needs = program(quantity.program, path);
  check_output(needs, quantity.output, path + "/output");
  if (needs.trajectory || needs.time || needs.parameter || needs.multiplier || needs.functional >= 0) {
    fail(path + "/program", "a quantity may depend on constants alone");
  }
  if (needs.constant >= static_cast<std::ptrdiff_t>(known)) {
    fail(path + "/program",
         "uses constant " + quoted(problem_.constants[needs.constant].name) + ", which is not declared before");
  }
}

void Declared::quantity(const Quantity& value, const std::string& path) const {
  quantity(value, path, problem_.constants.size());
}

void Declared::quantities(const std::vector<Quantity>& list, const std::string& path) const {
  for (std::size_t i = 0; i < list.size(); ++i) quantity(list[i], below(path, i));
}

void Declared::positive(const Quantity& value, const std::string& path) const {
  quantity(value, path);
  if (value.program.empty() && !(value.number > 0)) fail(path, "must be positive");
}

void Declared::not_negative(const Quantity& value, const std::string& path) const {
  quantity(value, path);
  if (value.program.empty() && value.number < 0) fail(path, "must not be negative");
}

void Declared::instant(const Quantity& time, const std::string& path) const {
  quantity(time, path);
  if (time.program.empty() && (time.number < problem_.start || time.number > problem_.end)) {
    fail(path, "is outside the problem's time");
  }
}

void Declared::instants(const std::vector<Quantity>& list, const std::string& path) const {
  for (std::size_t i = 0; i < list.size(); ++i) instant(list[i], below(path, i));
}

void Declared::bounds(const std::optional<Quantity>& lower, const std::optional<Quantity>& upper,
                      const std::string& path) const {
  if (lower) quantity(*lower, path + "/lower");
  if (upper) quantity(*upper, path + "/upper");
  if (lower && upper && reversed(*lower, *upper)) fail(path + "/upper", "is below the lower bound");
}

void Declared::keys(const std::vector<Key>& keys, const std::string& path) const {
  Names keyed;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const auto own = below(path + "/keys", k);
    dof(keys[k].dof, own + "/dof");
    if (!keyed.insert(keys[k].dof).second) fail(own + "/dof", quoted(keys[k].dof) + " has a key at this time already");
    quantity(keys[k].value, own + "/value");
  }
}

void Declared::scope_ends(const Scope& scope, const std::string& path) const {
  instant(scope.from, path + "/from");
  instant(scope.to, path + "/to");
  if (reversed(scope.from, scope.to)) fail(path + "/to", "is before its start");
}

double Declared::scope(const Scope& scope, const Needs& needs, const std::string& path) const {
  switch (scope.kind) {
    case Scope::Kind::once:
      check_timeless(needs, path + "/kind");
      return 1;
    case Scope::Kind::times:
      if (scope.times.empty()) fail(path + "/times", "names no time");
      instants(scope.times, path + "/times");
      return static_cast<double>(scope.times.size());
    case Scope::Kind::every:
      scope_ends(scope, path);
      positive(scope.step, path + "/step");
      if (!scope.step.program.empty() || !scope.from.program.empty() || !scope.to.program.empty()) return 1;
      return std::floor((scope.to.number - scope.from.number) / scope.step.number) + 2;
    case Scope::Kind::count:
      scope_ends(scope, path);
      if (scope.count < 2) fail(path + "/count", "must be at least 2: both ends are among them");
      return scope.count;
    case Scope::Kind::knots:
      scope_ends(scope, path);
      return static_cast<double>(most_knots_);
    case Scope::Kind::whole:
      return static_cast<double>(most_knots_);
  }
  fail(path + "/kind", "is no kind of scope");
}

}  // namespace spacetime
