// Every scene there is in the source tree: files, the manual's, and those in tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/symbolic/compiled.h"

namespace spacetime::symbolic {

// What stands between the marks, piece by piece.
inline std::vector<std::string> between(const std::string& text, std::string_view open, std::string_view close) {
  std::vector<std::string> out;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    const std::size_t end = text.find(close, at);
    if (end == std::string::npos) break;
    out.push_back(text.substr(at, end - at));
    at = end + close.size();
  }
  return out;
}

inline std::vector<std::string> manual_blocks() { return between(file_text("symbolic/LANGUAGE.md"), "```\n", "```\n"); }

// By where they are; scenes without mistakes only.
inline std::vector<std::pair<std::string, std::string>> scene_texts() {
  std::vector<std::pair<std::string, std::string>> out;
  const std::filesystem::path root(SPACETIME_SOURCE_DIR);
  for (const char* folder : {"examples", "tests"})
    for (const auto& file : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string path = file.path().lexically_relative(root).string(), kind = file.path().extension().string();
      if (kind == ".scene") out.emplace_back(path, file_text(path));
      if (kind == ".cpp" || kind == ".h")
        for (std::string& text : between(file_text(path), "R\"(", ")\"")) out.emplace_back(path, std::move(text));
    }
  std::string manual;
  for (const std::string& block : manual_blocks()) manual += block;
  out.emplace_back("symbolic/LANGUAGE.md", manual);
  std::erase_if(out, [](const auto& scene) { return !compile(scene.second).problem; });
  return out;
}

}  // namespace spacetime::symbolic
