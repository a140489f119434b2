// The few OpenGL objects that drawing needs, each owned by one value.
#pragma once

#include <epoxy/gl.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <span>

#include "gui/render/picture.h"

namespace spacetime::gui {

// A compiled and linked program; texts are joined.  What does not compile is a mistake of ours.
class Shader {
 public:
  Shader(std::initializer_list<const char*> vertex, std::initializer_list<const char*> fragment);
  ~Shader();
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;

  void use() const { glUseProgram(program_); }
  // Of the program in use.
  void set(const char* name, float value) const { glUniform1f(at(name), value); }
  void set(const char* name, int value) const { glUniform1i(at(name), value); }
  void set(const char* name, const glm::vec3& value) const { glUniform3f(at(name), value.x, value.y, value.z); }
  void set(const char* name, const Colour& c) const { glUniform3f(at(name), c.red, c.green, c.blue); }
  void set(const char* name, const glm::mat4& value) const { glUniformMatrix4fv(at(name), 1, GL_FALSE, &value[0][0]); }

 private:
  GLint at(const char* name) const { return glGetUniformLocation(program_, name); }
  GLuint program_ = 0;
};

// Vertices of floats only; `widths` has the number of floats of each attribute.
class Vertices {
 public:
  explicit Vertices(std::initializer_list<int> widths);
  ~Vertices();
  Vertices(const Vertices&) = delete;
  Vertices& operator=(const Vertices&) = delete;

  template <class Vertex>
  void put(std::span<const Vertex> vertices) {
    put(vertices.data(), vertices.size_bytes(), vertices.size());
  }
  void draw() const { draw(count_); }  // as triangles
  void draw(GLsizei count) const;      // so many vertices, which the shader may make by itself

 private:
  void put(const void* data, std::size_t bytes, std::size_t count);
  GLuint array_ = 0, buffer_ = 0;
  GLsizei count_ = 0;
};

// A square that holds depths as the light sees them.
class ShadowMap {
 public:
  explicit ShadowMap(int edge);
  ~ShadowMap();
  ShadowMap(const ShadowMap&) = delete;
  ShadowMap& operator=(const ShadowMap&) = delete;

  int edge() const { return edge_; }
  void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }
  void use() const { glBindTexture(GL_TEXTURE_2D, texture_); }

 private:
  int edge_;
  GLuint framebuffer_ = 0, texture_ = 0;
};

}  // namespace spacetime::gui
