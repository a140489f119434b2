// Where in the scene's text something was written: two optional members, "line" and "column", of what was written
// there.
#pragma once

#include "common/problem.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

inline void write_place(Writer& to, const Place& place) {
  if (place.line != 0) to.member("line", place.line);
  if (place.column != 0) to.member("column", place.column);
}

inline Place place_from(const Node& node) {
  Place place;
  if (const auto line = node.find("line")) place.line = line->integer(1);
  if (const auto column = node.find("column")) place.column = column->integer(1);
  return place;
}

}  // namespace spacetime
