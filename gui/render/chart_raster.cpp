// A drawing as pixels: each pixel is covered by a line as far as its centre lies within half the width; letters come
// from a font.
#include <stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/diagnostic.h"
#include "common/files.h"
#include "gui/render/chart.h"

namespace spacetime::gui {
namespace {

constexpr const char* font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

void blend(Image& image, int x, int y, const Colour& colour, float share) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::uint8_t* const pixel = image.at(x, y);
  const float parts[]{colour.red, colour.green, colour.blue};
  for (int k = 0; k < 3; ++k) {
    const float old = static_cast<float>(pixel[k]);
    pixel[k] = static_cast<std::uint8_t>(std::lround(old + share * (255 * parts[k] - old)));
  }
}

float distance(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
  const glm::vec2 along = b - a;
  const float length = glm::dot(along, along);
  const float share = length > 0 ? std::clamp(glm::dot(p - a, along) / length, 0.0F, 1.0F) : 0.0F;
  return glm::length(p - a - share * along);
}

// Coverage is collected over the whole line first, so that its pieces do not darken one another where they meet.
void paint(Image& image, const Drawing::Stroke& stroke, std::vector<float>& cover) {
  std::ranges::fill(cover, 0.0F);
  const float reach = 0.5F * stroke.width + 1;
  for (std::size_t i = 1; i < stroke.points.size(); ++i) {
    const glm::vec2 a = stroke.points[i - 1], b = stroke.points[i];
    const glm::ivec2 low = glm::max(glm::ivec2(glm::floor(glm::min(a, b) - reach)), glm::ivec2(0));
    const glm::ivec2 high =
        glm::min(glm::ivec2(glm::ceil(glm::max(a, b) + reach)), glm::ivec2(image.width - 1, image.height - 1));
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const float off = distance(glm::vec2(x, y) + 0.5F, a, b);
        float& share = cover[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + x];
        share = std::max(share, std::clamp(0.5F * stroke.width + 0.5F - off, 0.0F, 1.0F));
      }
    }
  }
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float share = cover[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + x];
      if (share > 0) blend(image, x, y, stroke.colour, share);
    }
  }
}

// The code points of UTF-8 text; what is none is passed over.
std::vector<int> code_points(const std::string& text) {
  std::vector<int> points;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    int rest = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
    int point = rest == 0 ? first : first & (0x3F >> rest);
    for (; rest > 0 && i < text.size(); --rest) point = point << 6 | (static_cast<unsigned char>(text[i++]) & 0x3F);
    points.push_back(point);
  }
  return points;
}

class Font {
 public:
  Font() {
    try {
      bytes_ = read_text(font_file);
    } catch (const InputError&) {
      throw InputError(std::string("the font ") + font_file +
                       " is missing: install the package fonts-dejavu-core; curves can be written as .svg without it");
    }
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes_.data());
    if (stbtt_InitFont(&info_, data, stbtt_GetFontOffsetForIndex(data, 0)) == 0)
      throw InputError(std::string(font_file) + " is no font");
  }

  void paint(Image& image, const Drawing::Word& word) const {
    const float scale = stbtt_ScaleForMappingEmToPixels(&info_, word.size);
    const auto points = code_points(word.text);
    float width = 0;
    for (const int point : points) width += scale * static_cast<float>(advance(point));
    float x = word.at.x - (word.anchor == Drawing::Anchor::middle ? width / 2
                           : word.anchor == Drawing::Anchor::end  ? width
                                                                  : 0);
    for (const int point : points) {
      const float whole = std::floor(x);
      int left = 0, top = 0, right = 0, bottom = 0;
      stbtt_GetCodepointBitmapBoxSubpixel(&info_, point, scale, scale, x - whole, 0, &left, &top, &right, &bottom);
      const int wide = right - left, high = bottom - top;
      if (wide > 0 && high > 0) {
        std::vector<unsigned char> shares(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high));
        stbtt_MakeCodepointBitmapSubpixel(&info_, shares.data(), wide, high, wide, scale, scale, x - whole, 0, point);
        const int row = static_cast<int>(std::lround(word.at.y)) + top;
        for (int j = 0; j < high; ++j) {
          for (int i = 0; i < wide; ++i) {
            const float share = static_cast<float>(shares[static_cast<std::size_t>(j * wide + i)]) / 255;
            blend(image, static_cast<int>(whole) + left + i, row + j, word.colour, share);
          }
        }
      }
      x += scale * static_cast<float>(advance(point));
    }
  }

 private:
  int advance(int point) const {
    int wide = 0, bearing = 0;
    stbtt_GetCodepointHMetrics(&info_, point, &wide, &bearing);
    return wide;
  }

  std::string bytes_;
  stbtt_fontinfo info_{};
};

}  // namespace

Image raster(const Drawing& drawing) {
  Image image(drawing.width, drawing.height);
  std::ranges::fill(image.rgba, std::uint8_t{255});
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) blend(image, x, y, drawing.background, 1);
  paint(image, drawing);
  return image;
}

void paint(Image& image, const Drawing& drawing) {
  static const Font font;
  std::vector<float> cover(image.rgba.size() / 4);
  for (const auto& stroke : drawing.strokes) paint(image, stroke, cover);
  for (const auto& word : drawing.words) font.paint(image, word);
}

}  // namespace spacetime::gui
