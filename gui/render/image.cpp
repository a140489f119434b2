#include "gui/render/image.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <memory>

#include "common/diagnostic.h"
#include "common/files.h"

namespace spacetime::gui {

std::string png(const Image& image) {
  std::string bytes;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(), 4 * image.width);
  return bytes;
}

void write_png(const std::string& file, const Image& image) { write_text(file, png(image)); }

Image read_png(const std::string& file) {
  const std::string bytes = read_text(file);
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width,
                            &height, &channels, 4),
      stbi_image_free);
  if (!pixels) throw InputError("'" + file + "' is no picture: " + stbi_failure_reason());
  Image image(width, height);
  std::copy_n(pixels.get(), image.rgba.size(), image.rgba.begin());
  return image;
}

}  // namespace spacetime::gui
