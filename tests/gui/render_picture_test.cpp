// Pictures, pixel by pixel: what is drawn where, in which colour.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "common/diagnostic.h"
#include "gui/render/offscreen.h"
#include "gui/render/palette.h"
#include "gui/render/renderer.h"
#include "gui/render/target.h"

namespace spacetime::gui {
namespace {

constexpr int width = 320, height = 200;
const glm::vec2 size{width, height};

// Drawn without a window; all tests share one context.
Image drawn(const Picture& picture, const Camera& camera, Quality quality = Quality::fine) {
  static Offscreen context;
  static Renderer renderer;
  Target target(width, height, 4);
  target.bind();
  renderer.draw(picture, camera, width, height, quality);
  return target.read();
}

Colour colour_at(const Image& image, const glm::vec2& pixel) {
  const auto* p = image.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
  return {static_cast<float>(p[0]) / 255, static_cast<float>(p[1]) / 255, static_cast<float>(p[2]) / 255};
}
Colour colour_at(const Image& image, const Camera& camera, const glm::vec3& point) {
  return colour_at(image, *project(camera, size, point));
}
float brightness(const Colour& c) { return (c.red + c.green + c.blue) / 3; }

// Of the same hue, lit more or less.
void expect_hue(const Colour& seen, const Colour& wanted) {
  const auto share = [](const Colour& c, float part) { return part / (c.red + c.green + c.blue); };
  EXPECT_NEAR(share(seen, seen.red), share(wanted, wanted.red), 0.06)
      << seen.red << ' ' << seen.green << ' ' << seen.blue;
  EXPECT_NEAR(share(seen, seen.blue), share(wanted, wanted.blue), 0.06);
}

const Colour blue = colour_of(0x2f6f9f), orange = colour_of(0xd9692f);

Solid capsule(const glm::vec3& from, const glm::vec3& to, const Colour& colour) {
  return {.shape = Solid::Shape::capsule,
          .radius = 0.05F,
          .extent = to - from,
          .pose = glm::translate(glm::mat4(1), from),
          .colour = colour};
}

TEST(Picture, AFigureHasItsColourWhereItsJointsAre) {
  for (const Theme theme : {Theme::light, Theme::dark}) {
    for (const View view : {View::front, View::free}) {
      Picture picture{.theme = theme};
      const glm::vec3 a{0, 0.5F, 0}, b{0.5F, 0.9F, 0}, c{1, 0.4F, 0};
      picture.solids = {capsule(a, b, blue), capsule(b, c, orange)};
      Box box;
      for (const Solid& s : picture.solids) box.include(bounds(s));
      const Camera camera = frame(looking(view), box, size, 0.15F);
      const Image image = drawn(picture, camera);
      expect_hue(colour_at(image, camera, 0.5F * (a + b)), blue);
      expect_hue(colour_at(image, camera, 0.5F * (b + c)), orange);
      // A third of a metre off the limb there is none of it.
      EXPECT_NEAR(brightness(colour_at(image, camera, {0.5F, 0.55F, 0})), brightness(palette(theme).below), 0.12);
    }
  }
}

TEST(Picture, ABoxAndASphereStandWhereTheirPosesPutThem) {
  Picture picture{.ground = false};
  const auto pose = glm::rotate(glm::translate(glm::mat4(1), {0.5F, 0, 0}), 0.785F, {0, 0, 1});
  picture.solids = {{.shape = Solid::Shape::box, .extent = {0.6F, 0.1F, 0.1F}, .pose = pose, .colour = blue},
                    {.radius = 0.2F, .pose = glm::translate(glm::mat4(1), {-0.5F, 0, 0}), .colour = orange}};
  const Camera camera{.distance = 4};
  const Image image = drawn(picture, camera);
  expect_hue(colour_at(image, camera, {0.68F, 0.18F, 0.05F}), blue);
  EXPECT_GT(brightness(colour_at(image, camera, {0.68F, -0.18F, 0})), 0.9);
  expect_hue(colour_at(image, camera, {-0.36F, 0, 0}), orange);
  EXPECT_GT(brightness(colour_at(image, camera, {-0.26F, 0, 0})), 0.9);
}

TEST(Picture, AFigureThrowsAShadowOnTheGround) {
  Picture with{.ground_height = 0};
  with.solids = {{.radius = 0.2F, .pose = glm::translate(glm::mat4(1), {0, 0.6F, 0}), .colour = blue}};
  const Camera camera = frame(looking(View::free), {{-0.6F, 0, -0.6F}, {0.6F, 0.8F, 0.6F}}, size);
  Picture without = with;
  without.solids.clear();
  // The light comes from (-0.45, 1, 0.55): the shadow of a point at height h lies h (0.45, 0, -0.55) beside it.
  const glm::vec3 spot{0.6F * 0.45F, 0, -0.6F * 0.55F};
  for (const Quality quality : {Quality::fast, Quality::fine}) {
    const Image image = drawn(with, camera, quality), bare = drawn(without, camera, quality);
    EXPECT_LT(brightness(colour_at(image, camera, spot)), brightness(colour_at(bare, camera, spot)) - 0.1);
    const glm::vec3 beside{0.5F, 0, 0.4F};
    EXPECT_NEAR(brightness(colour_at(image, camera, beside)), brightness(colour_at(bare, camera, beside)), 0.01);
  }
}

TEST(Picture, GhostsAreBeneathTheFigureAndPaler) {
  Picture picture{.ground = false};
  Solid ghost{.radius = 0.3F, .colour = orange, .opacity = 0.3F, .layer = 1};
  picture.solids = {ghost};
  const Camera camera{.distance = 4};
  const Colour pale = colour_at(drawn(picture, camera), camera, {0, 0, 0});
  EXPECT_GT(brightness(pale), brightness(orange) + 0.15);
  picture.solids.push_back({.radius = 0.1F, .pose = glm::translate(glm::mat4(1), {0, 0, -1}), .colour = blue});
  expect_hue(colour_at(drawn(picture, camera), camera, {0, 0, -1}), blue);  // though it is behind
}

TEST(Picture, LinesHideBehindSolidsAndMarksDoNot) {
  Picture picture{.ground = false};
  picture.solids = {{.radius = 0.3F, .colour = blue}};
  picture.lines = {{.points = {{-1, 0, -0.5F}, {1, 0, -0.5F}}, .colour = orange, .width = 5}};
  const Camera camera{.distance = 4};
  const Image image = drawn(picture, camera);
  expect_hue(colour_at(image, camera, {0.7F, 0, -0.5F}), orange);
  expect_hue(colour_at(image, camera, {0, 0, 0}), blue);
  picture.marks = {{.kind = Mark::Kind::met, .place = {0, 0, -0.5F}}};
  expect_hue(colour_at(drawn(picture, camera), camera, {0, 0, 0}), palette(Theme::light).met);
}

TEST(Picture, ArrowsAndTorquesEndInTheirHeads) {
  Picture picture{.ground = false};
  picture.arrows = {{.from = {-0.5F, 0, 0}, .to = {0, 0, 0}, .colour = orange, .width = 4}};
  picture.torques = {
      {.centre = {0.6F, 0, 0}, .axis = {0, 0, 1}, .angle = 3.1416F, .radius = 0.3F, .colour = blue, .width = 4}};
  const Camera camera{.distance = 4};
  const Image image = drawn(picture, camera);
  expect_hue(colour_at(image, camera, {-0.3F, 0, 0}), orange);
  expect_hue(colour_at(image, camera, {-0.03F, 0, 0}), orange);
  EXPECT_GT(brightness(colour_at(image, camera, {0.1F, 0, 0})), 0.9);
  int blues = 0;  // half a circle about its centre, and nothing of the other half
  for (int k = 0; k < 40; ++k) {
    const float phi = 0.157F * (static_cast<float>(k) + 0.5F);
    const Colour c = colour_at(image, camera, glm::vec3{0.6F + 0.3F * std::cos(phi), 0.3F * std::sin(phi), 0});
    blues += c.blue > c.red + 0.2F ? 1 : 0;
  }
  EXPECT_GE(blues, 17);
  EXPECT_LE(blues, 24);
}

TEST(Picture, ALineThatPassesTheEyeIsCutOffThere) {
  Picture picture{.ground = false};
  picture.lines = {{.points = {{0.2F, -0.1F, -2}, {0.2F, -0.1F, 9}}, .colour = orange, .width = 5}};
  const Camera camera{.distance = 4};
  const Image image = drawn(picture, camera);
  expect_hue(colour_at(image, camera, {0.2F, -0.1F, 2}), orange);
  // Nothing from the part behind the eye, which would appear on the other side.
  EXPECT_GT(brightness(colour_at(image, glm::vec2{40, 60})), 0.9);
}

TEST(Picture, EdgesAreSmooth) {
  Picture picture{.ground = false};
  picture.solids = {{.shape = Solid::Shape::box,
                     .extent = {1, 0.5F, 0.1F},
                     .pose = glm::rotate(glm::mat4(1), 0.1F, {0, 0, 1}),
                     .colour = blue}};
  const Camera camera{.distance = 4};
  const Image image = drawn(picture, camera);
  const float face = colour_at(image, camera, {0, 0, 0}).red, ground = colour_at(image, glm::vec2{4, 4}).red;
  int between = 0;  // neither the face nor the background
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float red = static_cast<float>(image.at(x, y)[0]) / 255;
      between += red > face + 0.1F && red < ground - 0.1F ? 1 : 0;
    }
  }
  EXPECT_GT(between, 40);
  EXPECT_LT(between, 600);
}

TEST(Picture, ASizeThatCannotBeDrawnIsRefused) {
  drawn({}, {});
  EXPECT_THROW(Target(0, 10, 4), InputError);
  EXPECT_THROW(Target(10, 1 << 20, 4), InputError);
}

TEST(Pick, FindsTheNearestSolidUnderThePixel) {
  Picture picture;
  picture.solids = {capsule({0, 0, 0}, {1, 0, 0}, blue), capsule({0, 0, -1}, {1, 0, -1}, orange)};
  picture.solids[0].id = 7;
  picture.solids[1].id = 8;
  picture.solids.push_back({.shape = Solid::Shape::box,
                            .extent = {0.2F, 0.2F, 0.2F},
                            .pose = glm::rotate(glm::translate(glm::mat4(1), {0, 0.5F, 0}), 0.785F, {0, 0, 1}),
                            .id = 9});
  picture.solids.push_back({.radius = 0.4F, .id = 10, .layer = 1});
  const auto at = [&](const glm::vec3& target) { return pick(picture, {{target.x, target.y, 5}, {0, 0, -2}}); };
  EXPECT_EQ(at({0.5F, 0, 0}), 7);
  EXPECT_EQ(at({1.04F, 0, 0}), 7);
  EXPECT_EQ(at({1.06F, 0, 0}), -1);
  EXPECT_EQ(at({0.5F, 0.06F, 0}), -1);
  EXPECT_EQ(at({0, 0.63F, 0}), 9);  // the corner of the turned box
  EXPECT_EQ(at({0.1F, 0.6F, 0}), -1);
  EXPECT_EQ(pick(picture, {{0.5F, 0, -5}, {0, 0, 1}}), 8);
  EXPECT_EQ(pick(picture, {{0.5F, 0, -5}, {0, 0, -1}}), -1);
}

TEST(Picture, PointsAreSoFarFromASolidsSurface) {
  Solid ball{.radius = 0.5F};
  ball.pose[3] = {1, 2, 3, 1};
  EXPECT_FLOAT_EQ(distance(ball, {3, 2, 3}), 1.5F);
  EXPECT_FLOAT_EQ(distance(ball, {1, 2, 3}), -0.5F);
  const Solid limb{.shape = Solid::Shape::capsule, .radius = 0.1F, .extent = {2, 0, 0}};
  EXPECT_FLOAT_EQ(distance(limb, {1, 1, 0}), 0.9F);
  EXPECT_FLOAT_EQ(distance(limb, {5, 4, 0}), 4.9F);
  const Solid box{.shape = Solid::Shape::box, .extent = {2, 4, 6}};
  EXPECT_FLOAT_EQ(distance(box, {4, 6, 0}), 5);
  EXPECT_FLOAT_EQ(distance(box, {0.5F, 0, 0}), -0.5F);
}

}  // namespace
}  // namespace spacetime::gui
