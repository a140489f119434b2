#include "gui/places.h"

#include <algorithm>
#include <cctype>

namespace spacetime::gui {

std::vector<PlaceHandle> places_of(const Problem& problem) {
  std::map<std::string, PlaceHandle> found;
  for (const Constant& constant : problem.constants) {
    if (constant.frozen || !constant.value.program.empty() || constant.name.size() < 2) continue;
    const char last = constant.name.back();
    const int axis = std::tolower(static_cast<unsigned char>(last)) - 'x';
    if (axis < 0 || axis > 2) continue;
    const std::string name = constant.name.substr(0, constant.name.size() - 1);
    // A capital letter that follows small ones, or a small one behind `_`: `gx` alone says too little.
    const bool spoken = std::isupper(static_cast<unsigned char>(last)) || name.back() == '_';
    if (!spoken) continue;
    PlaceHandle& place = found[name];
    place.name = name.back() == '_' ? name.substr(0, name.size() - 1) : name;
    place.parts[static_cast<std::size_t>(axis)] = constant.name;
  }
  std::vector<PlaceHandle> out;
  for (const auto& [name, place] : found)
    if (std::ranges::count(place.parts, "") <= 1) out.push_back(place);
  return out;
}

glm::dvec3 at(const PlaceHandle& place, const std::map<std::string, double>& constants) {
  glm::dvec3 out(0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = constants.find(place.parts[static_cast<std::size_t>(axis)]);
    if (value != constants.end()) out[axis] = value->second;
  }
  return out;
}

}  // namespace spacetime::gui
