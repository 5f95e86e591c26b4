#include "render/vtk/scene_renderer.hpp"

#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
// Before GL's own headers.
#include <vtk_glew.h>
// After it.
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVersion.h>

#include "core/base/errors.hpp"
#include "render/vtk/part_props.hpp"
#include "render/vtk/vtk_window.hpp"

namespace mapproof {
namespace {

/// Keeps what VTK reports, which would otherwise go to the standard error stream or to a window.
class ErrorLog : public vtkOutputWindow {
 public:
  static ErrorLog* New();
  vtkTypeMacro(ErrorLog, vtkOutputWindow)

      void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (errors.empty()) errors = text;
  }

  std::string errors;
};

vtkStandardNewMacro(ErrorLog);

std::string gl_text(GLenum what) {
  const auto* text = reinterpret_cast<const char*>(glGetString(what));
  return text == nullptr ? "unknown" : text;
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

void set_camera(const Camera& from, vtkCamera* to) {
  to->SetPosition(from.eye.data());
  to->SetFocalPoint(from.target.data());
  to->SetViewUp(from.up.data());
  to->SetParallelProjection(from.parallel);
  to->SetParallelScale(from.height / 2.0);
  to->SetViewAngle(from.angle_rad * 180.0 / std::numbers::pi);
}

void add_lights(const Scene& scene, vtkRenderer* renderer) {
  renderer->AutomaticLightCreationOff();
  for (const Light& one : scene.lights) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->PositionalOff();
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetPosition(one.from.data());
    light->SetIntensity(one.strength);
    renderer->AddLight(light);
  }
}

/// Upside down, as OpenGL has it, to Image's rows.
Image image_of(vtkUnsignedCharArray* bytes, int width, int height) {
  Image image{width, height, std::vector<std::uint32_t>(static_cast<std::size_t>(width) * height)};
  for (int y = 0; y < height; ++y) {
    const auto from = static_cast<vtkIdType>(height - 1 - y) * width;
    const unsigned char* pixel = bytes->GetPointer(3 * from);
    std::uint32_t* row = image.row(y);
    for (int x = 0; x < width; ++x, pixel += 3)
      row[x] = static_cast<std::uint32_t>(pixel[0]) << 16 | pixel[1] << 8 | pixel[2];
  }
  return image;
}

}  // namespace

struct SceneRenderer::Parts {
  vtkNew<ErrorLog> log;
  vtkSmartPointer<vtkRenderWindow> window;
};

void pin_driver() {
  ::setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  ::setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
  for (const char* name : {"MESA_GL_VERSION_OVERRIDE", "MESA_EXTENSION_OVERRIDE", "LP_PERF",
                           "LP_DEBUG", "GALLIVM_PERF", "GALLIVM_DEBUG", "GALLIUM_NOSSE",
                           "MESA_DEBUG", "LIBGL_ALWAYS_INDIRECT", "VTK_DEFAULT_OPENGL_WINDOW"})
    ::unsetenv(name);
}

SceneRenderer::SceneRenderer() : parts_(std::make_unique<Parts>()) {
  vtkOutputWindow::SetInstance(parts_->log);
  parts_->window = make_window();
}

SceneRenderer::~SceneRenderer() = default;

std::string SceneRenderer::name() const {
  return fmt::format("VTK {}, OpenGL {}, {}", vtkVersion::GetVTKVersion(), gl_text(GL_VERSION),
                     gl_text(GL_RENDERER));
}

Image SceneRenderer::draw(const Scene& scene, const SceneRequest& request) {
  if (request.view >= scene.views.size()) throw InvalidInput("there is no such view");
  const Shot& view = scene.views[request.view];
  vtkNew<vtkRenderer> renderer;
  const Colour paper = request.background;
  renderer->SetBackground(paper.red / 255.0, paper.green / 255.0, paper.blue / 255.0);
  add_lights(scene, renderer);
  for (std::size_t i = 0; i < scene.parts.size(); ++i)
    if (shows(view, i))
      for (const auto& prop : props_of(scene.parts[i], request)) renderer->AddViewProp(prop);
  set_camera(view.camera, renderer->GetActiveCamera());
  renderer->ResetCameraClippingRange();

  vtkRenderWindow* window = parts_->window;
  window->SetMultiSamples(request.samples);
  window->SetSize(request.width, request.height);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, request.width - 1, request.height - 1, 0, bytes);
  window->RemoveRenderer(renderer);
  if (!parts_->log->errors.empty())
    throw std::runtime_error("VTK: " + one_line(std::exchange(parts_->log->errors, {})));
  return image_of(bytes, request.width, request.height);
}

}  // namespace mapproof
