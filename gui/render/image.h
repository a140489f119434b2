// A picture of pixels, and PNG files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace spacetime::gui {

// Red, green, blue and opacity, 8 bits each, not premultiplied; rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgba(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::uint8_t* at(int x, int y) { return rgba.data() + 4 * (static_cast<std::size_t>(y) * width + x); }
  const std::uint8_t* at(int x, int y) const { return rgba.data() + 4 * (static_cast<std::size_t>(y) * width + x); }
  bool operator==(const Image&) const = default;
};

// The bytes of a PNG file.
std::string png(const Image& image);

// Both throw InputError.  A file is written beside, then renamed (common/files.h).
void write_png(const std::string& file, const Image& image);
Image read_png(const std::string& file);

}  // namespace spacetime::gui
