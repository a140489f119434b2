#include "symbolic/value.h"

#include <algorithm>

namespace spacetime::symbolic {

std::vector<std::uint8_t> reachable(const Graph& graph, std::span<const Expr> roots) {
  std::uint32_t last = 0;
  for (const auto root : roots) last = std::max(last, root.id);
  std::vector<std::uint8_t> needed(std::size_t{last} + 1);
  for (const auto root : roots) needed[root.id] = 1;
  for (std::size_t id = needed.size(); id-- > 0;) {
    if (!needed[id]) continue;
    const auto& n = graph.node({static_cast<std::uint32_t>(id)});
    if (n.kind != Graph::Kind::operation) continue;
    const int arity = info(n.op).arity;
    needed[n.a.id] = 1;
    if (arity > 1) needed[n.b.id] = 1;
    if (arity > 2) needed[n.c.id] = 1;
  }
  return needed;
}

}  // namespace spacetime::symbolic
