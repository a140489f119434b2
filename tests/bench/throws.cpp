#include "tests/bench/throws.h"

#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "common/diagnostic.h"
#include "optimizer/sketch.h"
#include "symbolic/compile.h"

namespace spacetime {

std::string file_text(const std::string& path) {
  std::ifstream in(std::string(SPACETIME_SOURCE_DIR "/") + path, std::ios::binary);
  if (!in) throw InputError("cannot read " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

Throw throw_named(const std::string& name) {
  static const std::map<std::string, std::string> scenes{{"P94", "examples/throw_eliminated.scene"},
                                                         {"P94R", "examples/throw_regularised.scene"},
                                                         {"P94J", "tests/golden/p94j.scene"},
                                                         {"P92", "tests/golden/p92.scene"}};
  const std::string text = file_text(scenes.at(name));
  Throw result{name, symbolic::compile(text).problem.value(), {}};

  const auto coefficients = nlohmann::json::parse(file_text("tests/reference/solve_coefs.json"));
  for (const std::string start : {"S0", "S1", "S2", "S3"}) {
    const std::string key = (name == "P92" ? "P92_start_" : "P94_start_") + start;
    result.starts.push_back({start, coefficients[key].get<std::vector<double>>()});
  }

  // A sketch replaces the line of the arm's own key.
  const auto key = text.find("arm.q = (0.8, 0.4, 0.2)"), at = text.rfind('\n', key) + 1, end = text.find('\n', key) + 1;
  if (key == std::string::npos) throw InputError(scenes.at(name) + " lacks the keyframe that sketches replace");
  const auto sketches = nlohmann::json::parse(file_text("tests/reference/p94r_results.json"))["map"]["runs"];
  for (const auto& sketch : sketches) {
    std::string keys;
    for (const auto& [time, q] : sketch["keys"].items()) {
      keys += "keyframe " + time + ": arm.q = (" + q[0].dump() + ", " + q[1].dump() + ", " + q[2].dump() + ")\n";
    }
    const Problem sketched = symbolic::compile(std::string(text).replace(at, end - at, keys)).problem.value();
    result.starts.push_back(
        {"sketch " + sketch["k"].dump(), optimizer::sketch(sketched, evaluate_constants(sketched))});
  }
  return result;
}

}  // namespace spacetime
