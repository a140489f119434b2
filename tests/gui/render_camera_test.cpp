// The camera against geometry written out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "common/diagnostic.h"
#include "gui/render/camera.h"

namespace spacetime::gui {
namespace {

const glm::vec2 size{1280, 720};

// A camera from the front: the triangle of eye, target and point, without matrices.
TEST(Camera, SeesFromTheFrontAsAPinholeDoes) {
  const Camera camera{.target = {1, 2, 3}, .distance = 4, .fov = 0.8F};
  const glm::vec3 point{1.5F, 2.25F, 2.0F};  // a metre beyond the target
  const float focal = 360 / std::tan(0.4F);  // pixels
  const auto at = project(camera, size, point);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x, 640 + focal * 0.5F / 5, 1e-2);
  EXPECT_NEAR(at->y, 360 - focal * 0.25F / 5, 1e-2);
  EXPECT_FALSE(project(camera, size, {1, 2, 8}));  // behind the eye
}

TEST(Camera, OrthographicSizesDoNotDependOnDepth) {
  const Camera camera{.distance = 4, .fov = 0.8F, .orthographic = true};
  const float pixels = 360 / (4 * std::tan(0.4F));  // a metre
  for (const float depth : {-3.0F, 0.0F, 10.0F}) {
    const auto at = project(camera, size, {0.5F, -0.25F, depth});
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->x, 640 + 0.5F * pixels, 1e-2);
    EXPECT_NEAR(at->y, 360 + 0.25F * pixels, 1e-2);
  }
}

TEST(Camera, StandardViewsPutTheAxesWhereTheyBelong) {
  const auto seen = [](View view, const glm::vec3& axis) {
    return *project(looking(view), size, 0.1F * axis) - 0.5F * size;
  };
  EXPECT_GT(seen(View::front, {1, 0, 0}).x, 10);
  EXPECT_LT(seen(View::front, {0, 1, 0}).y, -10);
  EXPECT_NEAR(glm::length(seen(View::front, {0, 0, 1})), 0, 1e-2);
  EXPECT_LT(seen(View::side, {0, 0, 1}).x, -10);  // from the right: z, towards the viewer in front, is at the left
  EXPECT_NEAR(glm::length(seen(View::side, {1, 0, 0})), 0, 1e-2);
  EXPECT_GT(seen(View::top, {1, 0, 0}).x, 10);
  EXPECT_GT(seen(View::top, {0, 0, 1}).y, 10);
  EXPECT_LT(seen(View::free, {0, 1, 0}).y, -10);
}

TEST(Camera, ARayThroughAPixelMeetsWhatIsSeenThere) {
  std::mt19937 random(4711);
  std::uniform_real_distribution<float> number(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    Camera camera{.target = {number(random), number(random), number(random)},
                  .distance = 3 + number(random),
                  .yaw = 3 * number(random),
                  .pitch = 1.5F * number(random),
                  .fov = 0.7F + 0.3F * number(random),
                  .orthographic = trial % 2 == 0};
    const glm::vec3 point = camera.target + glm::vec3{number(random), number(random), number(random)};
    const auto at = project(camera, size, point);
    ASSERT_TRUE(at);
    const Ray ray = ray_through(camera, size, *at);
    EXPECT_NEAR(glm::length(glm::cross(point - ray.origin, ray.direction)), 0, 3e-4) << trial;
    EXPECT_GT(glm::dot(point - ray.origin, ray.direction), 0) << trial;
  }
}

TEST(Camera, PanFollowsTheMouseAndZoomKeepsWhatIsUnderIt) {
  const Camera camera = looking(View::free, {.target = {0.3F, 1, -0.2F}, .distance = 3});
  const glm::vec2 pixels{57, -33};
  const auto moved = project(pan(camera, pixels, size), size, camera.target);
  EXPECT_NEAR(glm::length(*moved - (0.5F * size + pixels)), 0, 0.05);

  const glm::vec2 mouse{900, 200};
  const Ray ray = ray_through(camera, size, mouse);
  const glm::vec3 back = glm::normalize(eye(camera) - camera.target);
  const float way = glm::dot(camera.target - ray.origin, back) / glm::dot(ray.direction, back);
  const glm::vec3 under = ray.origin + way * ray.direction;  // at the target's depth
  const Camera closer = zoom(camera, 1.7F, mouse, size);
  EXPECT_NEAR(closer.distance, 3 / 1.7F, 1e-5);
  EXPECT_NEAR(glm::length(*project(closer, size, under) - mouse), 0, 0.05);
}

TEST(Camera, OrbitKeepsTheTargetAndStopsAtThePoles) {
  const Camera camera{.target = {1, 2, 3}};
  const Camera turned = orbit(camera, 0.4F, 9);
  EXPECT_NEAR(glm::length(*project(turned, size, camera.target) - 0.5F * size), 0, 1e-2);
  EXPECT_GT(eye(turned).y, camera.target.y);
  EXPECT_LE(turned.pitch, 1.5708F);
}

TEST(Camera, AFramedBoxFillsThePictureButForTheMargin) {
  const Box box{{-1, 0, -0.5F}, {3, 1, 0.5F}};
  for (const bool orthographic : {false, true}) {
    for (const View view : {View::front, View::side, View::top, View::free}) {
      Camera camera;
      camera.orthographic = orthographic;
      camera = frame(looking(view, camera), box, size, 0.1F);
      glm::vec2 low(1), high(-1);  // of the half of the picture about its centre
      for (int k = 0; k < 8; ++k) {
        const glm::vec3 corner{k & 1 ? 3 : -1, k & 2 ? 1 : 0, k & 4 ? 0.5F : -0.5F};
        const glm::vec2 off = (*project(camera, size, corner) - 0.5F * size) / (0.5F * size);
        low = glm::min(low, off);
        high = glm::max(high, off);
      }
      const std::string which =
          "view " + std::to_string(static_cast<int>(view)) + (orthographic ? " orthographic" : "");
      EXPECT_NEAR(std::max(high.x, high.y), 0.8F, 5e-3) << which;
      EXPECT_NEAR(high.x, -low.x, 5e-3) << which;
      EXPECT_NEAR(high.y, -low.y, 5e-3) << which;
    }
  }
}

TEST(RenderCamera, IsReadBackFromItsText) {
  for (const bool orthographic : {false, true}) {
    Camera camera{{0.5F, -1.25F, 3}, 7.5F, 1.2F, -0.3F, 0.6F, orthographic};
    const Camera read = read_camera(camera_text(camera));
    EXPECT_NEAR(read.yaw, camera.yaw, 1e-6);
    EXPECT_NEAR(read.pitch, camera.pitch, 1e-6);
    EXPECT_EQ(read.target, camera.target);
    EXPECT_EQ(read.distance, camera.distance);
    EXPECT_EQ(read.orthographic, orthographic);
  }
  for (const char* wrong : {"", "1,2,3", "0,0,0,0,0,0", "0,0,0,0,91,1", "0,0,0,0,0,1,flat", "0,nan,0,0,0,1", "a"})
    EXPECT_THROW(read_camera(wrong), InputError) << wrong;
}

}  // namespace
}  // namespace spacetime::gui
