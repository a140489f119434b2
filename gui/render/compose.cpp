#include "gui/render/compose.h"

#include <algorithm>
#include <cmath>

#include "common/sample.h"

namespace spacetime::gui {
namespace {

constexpr double trail_rate = 120;  // points a second: smooth at any size

Picture bare(const Figures& figures, const Motion& motion, const Look& look) {
  return {.ground_height = ground_height(figures.bounds(motion)), .theme = look.theme};
}

void add_trails(Picture& picture, const Figures& figures, const Motion& motion, double until, const Look& look,
                bool dashed) {
  const int count = std::max(2, static_cast<int>(std::ceil((until - motion.start) * trail_rate)));
  const auto times = even_times(motion.start, until, count);
  for (const std::string& trail : look.trails) {
    picture.lines.push_back({.points = figures.way(motion, trail, times),
                             .colour = figures.colour_of_point(trail, look.theme),
                             .width = 2,
                             .opacity = 0.75F,
                             .dashed = dashed});
  }
}

}  // namespace

Picture moment(const Figures& figures, const Motion& motion, double time, const Look& look) {
  Picture picture = bare(figures, motion, look);
  picture.solids = figures.solids(motion, time, look.theme);
  add_trails(picture, figures, motion, time, look, false);
  return picture;
}

Picture strip(const Figures& figures, const Motion& motion, int poses, const Look& look) {
  Picture picture = bare(figures, motion, look);
  const auto times = even_times(motion.start, motion.end, poses);
  picture.solids = figures.ghosts(motion, std::span(times).first(times.size() - 1), look.theme);
  for (const Solid& solid : figures.solids(motion, motion.end, look.theme)) picture.solids.push_back(solid);
  add_trails(picture, figures, motion, motion.end, look, true);
  return picture;
}

Picture apart(const Figures& figures, const Motion& motion, int poses, const Look& look) {
  constexpr float room = 1.15F;  // for a pose, over the widest one's width
  Picture picture = bare(figures, motion, look);
  std::vector<std::vector<Solid>> all;
  std::vector<Box> boxes;
  float widest = 0;
  for (const double t : even_times(motion.start, motion.end, poses)) {
    all.push_back(figures.solids(motion, t, look.theme));
    boxes.emplace_back();
    for (const Solid& solid : all.back()) boxes.back().include(bounds(solid));
    widest = std::max(widest, boxes.back().size().x);
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    const float shift = room * widest * static_cast<float>(k) - boxes[k].centre().x;
    for (Solid& solid : all[k]) {
      solid.pose[3].x += shift;
      picture.solids.push_back(solid);
    }
  }
  return picture;
}

Box bounds(const Picture& picture) {
  Box box;
  for (const Solid& solid : picture.solids) box.include(bounds(solid));
  return box;
}

Camera overview(const Box& bounds, View view, const glm::vec2& size) {
  Box room = bounds;
  if (!room.empty() && ground_height(bounds) < room.low.y + 0.5F * room.size().y) {
    room.low.y = std::min(room.low.y, ground_height(bounds));
  }
  return frame(looking(view), room, size, 0.1F);
}

}  // namespace spacetime::gui
