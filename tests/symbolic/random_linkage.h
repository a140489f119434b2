// Random trees of links with every kind of joint, and the numbers to try them at.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "symbolic/mechanics.h"
#include "tests/symbolic/planar_arm.h"

namespace spacetime::symbolic {

struct RandomLinkage {
  Linkage linkage;
  std::vector<Coordinate> coordinates;  // in the order of links
};

// Half of the constant angles are multiples of a quarter turn, so that joints in a row are often parallel; some axes
// follow the coordinate axes, some do not; some links have no mass, some no inertia.
inline RandomLinkage random_linkage(Graph& graph, int links, std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const auto below = [&](int n) { return std::uniform_int_distribution(0, n - 1)(random); };
  const auto number = [&](double low, double high) { return graph.number(uniform(low, high)); };
  const auto angle = [&] { return below(2) == 0 ? graph.pi(0.5 * (below(4) - 1)) : number(-3, 3); };
  const auto vector = [&](double size) {
    return Vector3{number(-size, size), number(-size, size), number(-size, size)};
  };

  RandomLinkage result;
  auto& linkage = result.linkage;
  linkage.gravity = vector(10);
  for (int k = 0; k < links; ++k) {
    Link link;
    link.parent = below(3) > 0 ? k - 1 : below(k + 1) - 1;
    link.joint =
        std::array{Link::Joint::revolute, Link::Joint::revolute, Link::Joint::prismatic, Link::Joint::fixed}[below(4)];
    if (link.joint != Link::Joint::fixed) {
      link.coordinate = coordinate(graph, numbered("q", k));
      result.coordinates.push_back(*link.coordinate);
    }
    link.offset = angle();
    if (below(2) == 0) {
      link.a = number(-1, 1), link.d = number(-1, 1);
      link.alpha = below(2) == 0 ? graph.number(0) : angle();
      link.theta = angle();
    } else {
      link.axis = vector(1);
      if (below(2) == 0) {
        link.axis = Vector3{};
        (*link.axis)[below(3)] = graph.number(below(2) == 0 ? -2 : 3);
      }
      link.origin = vector(1);
    }
    if (below(4) > 0) link.mass = number(0.1, 2);
    if (below(2) == 0) link.com = vector(0.5);
    if (below(2) == 0) {  // of three point masses, so that it is one that a body can have
      double s[3][3] = {};
      for (int point = 0; point < 3; ++point) {
        const double x[3] = {uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-0.5, 0.5)};
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) s[i][j] += x[i] * x[j];
        }
      }
      const double values[] = {s[1][1] + s[2][2], s[0][0] + s[2][2], s[0][0] + s[1][1], -s[0][1], -s[0][2], -s[1][2]};
      for (int i = 0; i < 6; ++i) link.inertia[i] = graph.number(values[i]);
    }
    linkage.links.push_back(link);
    if (below(4) == 0) linkage.forces.push_back({k, vector(0.5), vector(5)});
  }
  return result;
}

}  // namespace spacetime::symbolic
