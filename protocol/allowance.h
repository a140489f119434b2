// What one peer may ask of a daemon.  Each bound has a name, a default, an option of `serve` (--limit-NAME) and an
// error of its own; `initialize` tells them all.  Bounds of documents themselves are in limits.h.
#pragma once

#include <array>
#include <string_view>

#include "protocol/limits.h"
#include "protocol/rpc.h"

namespace spacetime::protocol {

struct Allowance {
  double message = static_cast<double>(limits::document_bytes);  // bytes
  double depth = static_cast<double>(limits::document_depth);    // objects and lists inside one another
  double waiting = 1000;                                         // requests that wait for their turn
  double operations = static_cast<double>(limits::operations);   // in all programs of a problem
  double unknowns = 4e6;                                         // coefficients and parameters of a problem
  double samples = 4e6;                                          // numbers in the answer to one `sample`
  double sessions = 16;                                          // connections at one time
  double idle = 86400;                                           // seconds without a request while nothing runs
  double memory = 2e9;                                           // bytes that one session holds
};

struct Bound {
  std::string_view name;
  double Allowance::*value;
  double least, most;  // that the option may set
  Code code;           // of the error
  std::string_view help;
};

inline constexpr std::array bounds{
    Bound{"message", &Allowance::message, 1024, static_cast<double>(limits::document_bytes), Code::too_long,
          "bytes of one message"},
    Bound{"depth", &Allowance::depth, 8, static_cast<double>(limits::document_depth), Code::too_deep,
          "objects and lists inside one another"},
    Bound{"waiting", &Allowance::waiting, 1, 1e6, Code::too_many_waiting, "requests of one session that wait"},
    Bound{"operations", &Allowance::operations, 1, static_cast<double>(limits::operations), Code::too_many_operations,
          "operations in all programs of a problem"},
    Bound{"unknowns", &Allowance::unknowns, 1, 1e9, Code::too_many_unknowns,
          "coefficients and parameters of a problem"},
    Bound{"samples", &Allowance::samples, 1, 1e9, Code::too_many_samples, "numbers in the answer to one `sample`"},
    Bound{"sessions", &Allowance::sessions, 1, 10000, Code::too_many_sessions, "connections at one time"},
    Bound{"idle", &Allowance::idle, 1e-3, 1e9, Code::idle, "seconds without a request while nothing runs"},
    Bound{"memory", &Allowance::memory, 1e6, 1e15, Code::out_of_memory, "bytes that one session holds"},
};

const Bound& bound_named(std::string_view name);  // must be there

// The error of a peer that asks for more: "<found> <what the bound counts>, more than the limit of <most>: ...".
Error beyond(std::string_view name, const Allowance& allowance, double found);

}  // namespace spacetime::protocol
