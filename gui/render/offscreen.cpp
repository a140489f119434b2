#include "gui/render/offscreen.h"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <array>
#include <string>

#include "common/diagnostic.h"

namespace spacetime::gui {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("there is no OpenGL to draw with (" + what +
                   "): install the packages libegl-mesa0 and libgl1-mesa-dri");
}

bool loadable(const char* library) {
  void* const handle = dlopen(library, RTLD_LAZY);
  if (handle != nullptr) dlclose(handle);
  return handle != nullptr;
}

// Without a screen: Mesa's surfaceless platform, else whatever the machine's default is.
EGLDisplay initialised_display() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) return display;
  }
  const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) refuse("EGL finds no display");
  return display;
}

}  // namespace

Offscreen::Offscreen() {
  if (!loadable("libEGL.so.1")) refuse("libEGL.so.1 is missing");  // epoxy would end the program
  display_ = initialised_display();
  constexpr std::array<EGLint, 3> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  constexpr std::array<EGLint, 7> version{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLConfig config = EGL_NO_CONFIG_KHR;
  EGLint configs = 0;
  if (eglBindAPI(EGL_OPENGL_API) == EGL_TRUE) {
    eglChooseConfig(display_, wanted.data(), &config, 1, &configs);
    context_ = eglCreateContext(display_, configs > 0 ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version.data());
  }
  if (context_ == EGL_NO_CONTEXT) {
    eglTerminate(display_);
    refuse("no context of OpenGL 3.3");
  }
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
    refuse("its context cannot be used without a surface");
  }
}

// The display stays initialised: it is the process's, for all its contexts, and drivers leak what they are unloaded
// with.
Offscreen::~Offscreen() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

}  // namespace spacetime::gui
