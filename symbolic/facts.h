// What is known about the nodes of a graph: what they depend on and, where that is constants alone, their value.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/graph.h"

namespace spacetime::symbolic {

class Facts {
 public:
  explicit Facts(const Graph& graph) : graph_(graph) {}

  // Before the constant's input is made; a name declared twice keeps its first value.
  void set_constant(const std::string& name, double value) { constants_.try_emplace(name, value); }
  // Before constants change their values: everything known is found anew.  Values that follow from one another are
  // given in the order of their declaration.
  void forget() { facts_.clear(); }
  void change_constant(const std::string& name, double value) { constants_[name] = value; }

  // Depends on a degree of freedom or on time itself (what stands inside a functional does not count).
  bool timed(Expr e) { return (of(e).uses & (motion | clock)) != 0; }
  bool moving(Expr e) { return (of(e).uses & motion) != 0; }
  bool has_functional(Expr e) { return (of(e).uses & functional) != 0; }
  bool has_constant(Expr e) { return (of(e).uses & constant) != 0; }
  bool has_parameter(Expr e) { return (of(e).uses & parameter) != 0; }

  // The value of what is made of numbers and constants, with the constants as declared; infinite or NaN where it has
  // none.  Nothing for everything else.
  std::optional<double> known(Expr e);

 private:
  enum Use : std::uint8_t { constant = 1, motion = 2, clock = 4, functional = 8, parameter = 16, unknown = 32 };
  struct Fact {
    std::uint8_t uses = 0;
    double value = 0;
  };

  const Fact& of(Expr e);
  Fact fact_of_input(const Input& input) const;

  const Graph& graph_;
  std::map<std::string, double> constants_;
  std::vector<Fact> facts_;  // by node id
};

}  // namespace spacetime::symbolic
