// Compiling edited texts again: programs are remembered by what they compute, so that an edit derives and emits only
// what it changed.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "symbolic/compile.h"
#include "symbolic/emit.h"
#include "symbolic/graph.h"
#include "symbolic/scene.h"

namespace spacetime::symbolic {

// Programs by the expressions they compute and the derivatives they have.  Those that the last three texts without
// mistakes did not use are forgotten, so that it does not grow with a session.
class Programs {
 public:
  struct Emitted {
    std::string key;  // the program's hash
    Program program;
    double tree_nodes = 0;         // as in Statistics
    std::size_t shared_nodes = 0;  // ...
    int used = 0;                  // by which text last
  };

  // The program of expressions that make up a whole graph (fingerprint.h's `copy` gives such).  Emits it into that
  // graph where it is not known yet, adding the milliseconds spent on derivatives.
  const Emitted& of(Graph& graph, std::span<const Expr> values, Derivatives derivatives, double& differentiating);

  void end_text();                                  // after one without mistakes: forgets what is old
  std::size_t derived() const { return derived_; }  // how many have been emitted since the beginning

 private:
  std::unordered_map<std::string, std::unique_ptr<Emitted>> programs_;
  int text_ = 0;
  std::size_t derived_ = 0;
};

// The tree of a scene; without statements where the text is too large, empty or no text, which is reported.
Scene parse_scene(std::string_view text, std::vector<Diagnostic>& diagnostics);
// Sorts them by place, and keeps as many as are read at once.
void put_in_order(std::vector<Diagnostic>& diagnostics);

// What `compile` does, for one text after another: each result is that of the text alone.
class Compiler {
 public:
  Compilation compile(std::string_view text);

 private:
  Programs programs_;
};

}  // namespace spacetime::symbolic
