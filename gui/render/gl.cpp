#include "gui/render/gl.h"

#include <array>
#include <cstdio>
#include <numeric>
#include <vector>

#include "common/assert.h"

namespace spacetime::gui {
namespace {

GLuint compiled(GLenum stage, std::initializer_list<const char*> texts) {
  std::vector<const char*> all{"#version 330 core\n"};
  all.insert(all.end(), texts);
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, static_cast<GLsizei>(all.size()), all.data(), nullptr);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done == 0) {
    std::array<char, 2000> log{};
    glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
    std::fputs(log.data(), stderr);
  }
  SPACETIME_ASSERT(done != 0);
  return shader;
}

}  // namespace

Shader::Shader(std::initializer_list<const char*> vertex, std::initializer_list<const char*> fragment)
    : program_(glCreateProgram()) {
  const GLuint stages[]{compiled(GL_VERTEX_SHADER, vertex), compiled(GL_FRAGMENT_SHADER, fragment)};
  for (const GLuint stage : stages) glAttachShader(program_, stage);
  glLinkProgram(program_);
  for (const GLuint stage : stages) glDeleteShader(stage);
  GLint done = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &done);
  SPACETIME_ASSERT(done != 0);
}

Shader::~Shader() { glDeleteProgram(program_); }

Vertices::Vertices(std::initializer_list<int> widths) {
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &buffer_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  const std::size_t stride = sizeof(float) * static_cast<std::size_t>(std::accumulate(widths.begin(), widths.end(), 0));
  std::size_t offset = 0;
  GLuint index = 0;
  for (const int width : widths) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index++, width, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                          reinterpret_cast<const void*>(offset));
    offset += sizeof(float) * static_cast<std::size_t>(width);
  }
}

Vertices::~Vertices() {
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(1, &buffer_);
}

void Vertices::put(const void* data, std::size_t bytes, std::size_t count) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
  count_ = static_cast<GLsizei>(count);
}

void Vertices::draw(GLsizei count) const {
  glBindVertexArray(array_);
  glDrawArrays(GL_TRIANGLES, 0, count);
}

ShadowMap::ShadowMap(int edge) : edge_(edge) {
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, edge, edge, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  constexpr std::array<float, 4> far{1, 1, 1, 1};
  glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, far.data());
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  SPACETIME_ASSERT(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(before));
}

ShadowMap::~ShadowMap() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &texture_);
}

}  // namespace spacetime::gui
