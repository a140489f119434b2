#include <gtest/gtest.h>

#include <filesystem>

#include "common/diagnostic.h"
#include "common/files.h"
#include "gui/render/image.h"

namespace spacetime::gui {
namespace {

std::string temporary(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) / ("spacetime_render_" + name)).string();
}

TEST(Image, APngReadsBackAsItWas) {
  Image image(37, 23);
  unsigned state = 12345;
  for (auto& byte : image.rgba) byte = static_cast<std::uint8_t>((state = state * 1664525U + 1013904223U) >> 24);
  const std::string file = temporary("random.png");
  write_png(file, image);
  EXPECT_EQ(read_png(file), image);
}

TEST(Image, WhatIsNoPictureIsRefusedByName) {
  const std::string file = temporary("no.png");
  write_text(file, "not a picture");
  try {
    read_png(file);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
  }
}

TEST(Image, AFileThatCannotBeWrittenIsRefused) {
  EXPECT_THROW(write_png("/nowhere/at/all.png", Image(2, 2)), InputError);
}

}  // namespace
}  // namespace spacetime::gui
