// Constants that are places: BasketX and BasketY are a point that can be dragged in the scene.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "common/problem.h"

namespace spacetime::gui {

struct PlaceHandle {
  std::string name;                  // what the constants' names have in common
  std::array<std::string, 3> parts;  // the constants of x, y and z; empty where there is none, which is 0 then
};

// Constants whose names differ in a last X, Y or Z (or x, y, z, with or without a `_`) alone: at least two of the
// three, none of them frozen or following from others.
std::vector<PlaceHandle> places_of(const Problem& problem);

glm::dvec3 at(const PlaceHandle& place, const std::map<std::string, double>& constants);

}  // namespace spacetime::gui
