// What a problem declares, by name, and the checks of whatever refers to it: shared by statements (problem_check) and
// actions (action_check).  All functions throw the Fault they find; `path` is the JSON pointer of what is checked.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "common/problem.h"
#include "protocol/check.h"

namespace spacetime {

[[noreturn]] void fail(std::string path, std::string message);
std::string quoted(std::string_view name);
// "there is no <what> "<name>"", what it may be meant for, or what there is.
std::string there_is_no(std::string_view what, std::string_view name, std::span<const std::string> present);

using Names = std::unordered_set<std::string_view>;
void check_name(std::string_view name, const std::string& path, Names& names);  // and that it is not among them yet
bool reversed(const Quantity& lower, const Quantity& upper);                    // plain numbers in the wrong order
void check_place(const Place& place, const std::string& path);

template <class Things>
std::vector<std::string> names_of(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.emplace_back(thing.name);
  return names;
}

// What a program needs to be given, and what it costs.
struct Needs {
  bool trajectory = false;  // a degree of freedom or a signal
  bool time = false;
  bool parameter = false;
  bool multiplier = false;
  std::ptrdiff_t constant = -1;    // the last one, by its place in Problem::constants; -1: none
  std::ptrdiff_t functional = -1;  // the same, in Problem::functionals
  std::size_t outputs = 0;
  std::size_t operations = 0;
};
void check_output(const Needs& needs, int output, const std::string& path);
// Whatever is evaluated once; `path` is that of what names the program.
void check_timeless(const Needs& needs, const std::string& path);

class Declared {
 public:
  using Places = std::unordered_map<std::string_view, std::size_t>;  // by name, in the problem's lists

  // Checks names, places, bases and what programs refer to; they themselves have been checked.  Refers to the problem.
  explicit Declared(const Problem& problem);

  const Problem& problem() const { return problem_; }
  const Places& constants() const { return constants_; }
  const Places& dofs() const { return dofs_; }
  const Places& constraints() const { return constraints_; }  // those that replace others left out
  const Places& terms() const { return terms_; }              // of the objective; likewise
  std::size_t most_knots() const { return most_knots_; }      // distinct ones of the finest basis

  const Needs& program(const std::string& name, const std::string& path) const;  // path/program names it
  void dof(const std::string& name, const std::string& path) const;

  // Quantities: in the third form only the first `known` constants may be used.
  void quantity(const Quantity& quantity, const std::string& path) const;
  void quantities(const std::vector<Quantity>& list, const std::string& path) const;
  void quantity(const Quantity& quantity, const std::string& path, std::size_t known) const;
  // The sign and the place in time are checked of plain numbers; others are for who evaluates them.
  void positive(const Quantity& quantity, const std::string& path) const;
  void not_negative(const Quantity& quantity, const std::string& path) const;
  void instant(const Quantity& time, const std::string& path) const;
  void instants(const std::vector<Quantity>& list, const std::string& path) const;
  // path/lower and path/upper.
  void bounds(const std::optional<Quantity>& lower, const std::optional<Quantity>& upper,
              const std::string& path) const;
  // path/since: an action, or behind all of them.
  void beginning(int since, const std::string& path) const;
  // path/keys: at most one a degree of freedom.
  void keys(const std::vector<Key>& keys, const std::string& path) const;
  // How many instances a constraint with these needs has, as far as the scope's numbers alone tell.
  double scope(const Scope& scope, const Needs& needs, const std::string& path) const;

 private:
  void declarations();
  void programs();
  void statements();
  template <class Statement>
  Places statements(const std::vector<Statement>& list, std::string_view list_path, Names& names) const;
  Needs needs_of(const Program& program, const std::string& path) const;
  void scope_ends(const Scope& scope, const std::string& path) const;

  const Problem& problem_;
  Places constants_, parameters_, dofs_, constraints_, terms_;
  std::unordered_map<std::string_view, Needs> needs_;
  std::size_t most_knots_ = 2;
};

// Throw the first Fault of what the problem's statements and actions mean.
void check_statements(const Declared& declared);
void check_actions(const Declared& declared);
// Likewise of an action that is no part of it, all statements having taken effect, and of several in their order.
void check_action(const Declared& declared, const Action& action, const std::string& path);
void check_edits(const Declared& declared, std::span<const Action> edits, const std::string& path);

}  // namespace spacetime
