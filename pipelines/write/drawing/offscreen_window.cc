#include "pipelines/write/drawing/offscreen_window.h"

// GLEW before anything that brings OpenGL.
#include <vtk_glew.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

#include <algorithm>

#include "pipelines/base/common/process_limits.h"

namespace pipelines {
namespace {

/// The EGL context; `context` is EGL_NO_CONTEXT if there is none.
class SurfacelessContext {
public:
  SurfacelessContext() {
    const auto get_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (!get_display) return;
    display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr) ||
        !eglBindAPI(EGL_OPENGL_API))
      return;
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint n_configs = 0;
    if (!eglChooseConfig(display_, wanted, &config, 1, &n_configs) || n_configs < 1) return;
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2, EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
  }
  ~SurfacelessContext() {
    if (context_ == EGL_NO_CONTEXT) return;
    if (is_current()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  SurfacelessContext(const SurfacelessContext&) = delete;
  SurfacelessContext& operator=(const SurfacelessContext&) = delete;

  bool make_current() const {
    return context_ != EGL_NO_CONTEXT && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  }
  bool is_current() const { return context_ != EGL_NO_CONTEXT && eglGetCurrentContext() == context_; }

private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow);

  bool works() {
    if (!context_.make_current()) return false;
    OpenGLInit();
    return Initialized;
  }
  void MakeCurrent() override { context_.make_current(); }
  bool IsCurrent() override { return context_.is_current(); }
  int SupportsOpenGL() override { return Initialized; }
  vtkTypeBool IsDirect() override { return 1; }
  /// Pictures are drawn into buffers of their own; there is no screen's, which VTK 9.3 asks with a warning.
  int GetColorBufferSizes(int* rgba) override {
    std::fill_n(rgba, 4, 8);
    return 4 * 8;
  }

  /// GLEW finds the functions of OpenGL, then complains that there is no X11 display: that does no harm.
  void OpenGLInitContext() override {
    ContextCreationTime.Modified();
    if (Initialized) return;
    glewExperimental = GL_TRUE;
    const GLenum result = glewInit();
    GlewInitValid = (result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY) && GLEW_VERSION_3_2;
    Initialized = GlewInitValid;
  }

protected:
  OffscreenWindow() { SetOffScreenRendering(1); }
  ~OffscreenWindow() override {
    MakeCurrent();
    Finalize();
  }

private:
  SurfacelessContext context_;
};

vtkStandardNewMacro(OffscreenWindow);

}  // namespace

std::shared_ptr<vtkRenderWindow> make_offscreen_window() {
  if (!has_memory_to_draw()) return nullptr;
  const auto window = vtkSmartPointer<OffscreenWindow>::New();
  if (!window->works()) return nullptr;
  return {window.Get(), [window](vtkRenderWindow*) {}};  // the deleter holds VTK's own reference
}

}  // namespace pipelines
