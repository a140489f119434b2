// What the person is told, and where.
#pragma once

#include <string>

namespace spacetime::gui {

enum class Severity { note, warning, error };

// Something to be told, where the person looks: beside what it is about.
struct Notice {
  enum class Place { status, scene_text, equations, constants, timeline, optimisation, console, view };
  Place place = Place::status;
  Severity severity = Severity::note;
  std::string text;
  std::string about{};   // the equation, constant or degree of freedom it is about; often empty
  double until = 0;      // State::clock at which it goes; 0: stays until the next act
  bool lasting = false;  // stays whatever is done, until it is dismissed or no more so
};

}  // namespace spacetime::gui
