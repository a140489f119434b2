// The planar arm of tests/reference/problems.md, built through the general mechanics.
#pragma once

#include <string>
#include <vector>

#include "symbolic/mechanics.h"

namespace spacetime::symbolic {

inline std::string numbered(std::string name, std::size_t number) { return name.append(std::to_string(number)); }

inline Coordinate coordinate(Graph& graph, const std::string& name) {
  const auto input = [&](int derivative) {
    return graph.input({.kind = InputKind::dof, .name = name, .index = 0, .derivative = derivative});
  };
  return {input(0), input(1), input(2)};
}

// Uniform rods in the vertical plane, revolute joints about z, hanging straight down at zero; the first joint sits on
// the origin.
inline Linkage planar_arm(Graph& graph, const std::vector<double>& lengths, const std::vector<double>& masses) {
  Linkage linkage;
  linkage.gravity = {graph.number(0), graph.number(-9.81), graph.number(0)};
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    Link link;
    link.joint = Link::Joint::revolute;
    link.parent = static_cast<int>(k) - 1;
    link.coordinate = coordinate(graph, numbered("q", k + 1));
    if (k == 0) link.offset = graph.pi(-0.5);
    link.a = graph.number(lengths[k]);
    link.mass = graph.number(masses[k]);
    link.com[0] = graph.number(-lengths[k] / 2);
    const auto inertia = graph.number(masses[k] * lengths[k] * lengths[k] / 12);
    link.inertia[1] = link.inertia[2] = inertia;
    linkage.links.push_back(link);
  }
  return linkage;
}

inline Linkage planar_arm(Graph& graph, int links) {
  return links == 3 ? planar_arm(graph, {0.5, 0.4, 0.2}, {2.0, 1.5, 0.5})
                    : planar_arm(graph, std::vector<double>(links, 0.3), std::vector<double>(links, 1.0));
}

inline Expr summed_squares(Graph& graph, const std::vector<Expr>& values) {
  Expr sum;
  for (const auto value : values) sum = graph.add(sum, graph.multiply(value, value));
  return sum;
}

// q1..qn, q1'..qn', q1''..qn''
inline std::vector<Expr> arm_inputs(const Linkage& linkage) {
  std::vector<Expr> result;
  for (const auto& link : linkage.links) result.push_back(link.coordinate->q);
  for (const auto& link : linkage.links) result.push_back(link.coordinate->v);
  for (const auto& link : linkage.links) result.push_back(link.coordinate->a);
  return result;
}

}  // namespace spacetime::symbolic
