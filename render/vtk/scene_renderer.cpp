#include "render/vtk/scene_renderer.hpp"

#include <unistd.h>
#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLight.h>
#include <vtkLogger.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVersion.h>
#include <vtkVersionMacros.h>
#include <vtk_glew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "render/scene/baked_light.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/scene_request.hpp"
#include "render/vtk/gl_context.hpp"
#include "render/vtk/scene_props.hpp"

namespace mapproof {
namespace {

/// A window that owns an OpenGL context, in which VTK draws into a framebuffer of its own.
class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow)

      /// Makes the context.
      void Initialize() override;
  void Finalize() override;
  void MakeCurrent() override;
  bool IsCurrent() override;
#ifdef GLEW_OK
  void OpenGLInitContext() override;
#endif
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 0; }

 protected:
  OffscreenWindow();
  ~OffscreenWindow() override;

 private:
  std::unique_ptr<GlContext> context_;
};

vtkStandardNewMacro(OffscreenWindow);

OffscreenWindow::OffscreenWindow() {
  SetShowWindow(false);
  SetUseOffScreenBuffers(true);
  SetFrameBlitModeToNoBlit();
  SetOwnContext(1);
  SetReadyForRendering(true);
#ifndef GLEW_OK
  SetOpenGLSymbolLoader([](void*, const char* name) { return GlContext::function(name); }, nullptr);
#endif
}

OffscreenWindow::~OffscreenWindow() { Finalize(); }

void OffscreenWindow::Initialize() {
  if (context_ != nullptr) return;
  auto context = std::make_unique<GlContext>();
  if (!context->make_current()) throw std::runtime_error("the context cannot be made current");
  context_ = std::move(context);
  OpenGLInit();
}

void OffscreenWindow::Finalize() {
  if (context_ == nullptr) return;
  MakeCurrent();
  Superclass::Finalize();
  context_.reset();
}

void OffscreenWindow::MakeCurrent() {
  if (context_ != nullptr && !context_->is_current()) context_->make_current();
}

bool OffscreenWindow::IsCurrent() { return context_ != nullptr && context_->is_current(); }

#ifdef GLEW_OK
/// As the base class does it, but a missing GLX display is not an error: GLEW looks for one only
/// after it has loaded every function of OpenGL.
void OffscreenWindow::OpenGLInitContext() {
  ContextCreationTime.Modified();
  if (Initialized) return;
  const GLenum result = glewInit();
  GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
  if (!GlewInitValid)
    throw std::runtime_error(std::string("GLEW: ") +
                             reinterpret_cast<const char*>(glewGetErrorString(result)));
  Initialized = true;
}
#endif

/// A window without a screen, with a current context (see GlContext).
/// @throws std::runtime_error, in one line, if no context can be made.
vtkSmartPointer<vtkRenderWindow> make_window() {
  auto window = vtkSmartPointer<OffscreenWindow>::New();
  window->Initialize();
  return window;
}

/// Keeps VTK's first error message; messages would otherwise go to standard error or to a window.
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

constexpr std::string_view kVersion = "OpenGL version string";
constexpr std::string_view kDriver = "OpenGL renderer string";

/// One entry of VTK's report about an OpenGL, as "OpenGL version string:  4.5 ...".
std::string capability(vtkRenderWindow* window, std::string_view what) {
  const std::string_view all = window->ReportCapabilities();
  const std::size_t found = all.find(what);
  if (found == std::string_view::npos) return "unknown";
  std::string_view text = all.substr(found + what.size());
  text = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(": ")));
  return std::string(text);
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

constexpr int kLongest = 16384;  // Side of an image of llvmpipe.

/// Samples along each side of a pixel, fewer than requested where a row would be too long for the
/// driver.
int side_samples(const SceneRequest& request) {
  int side = 1;
  while (side * side < request.samples) ++side;
  while (side > 1 && side * request.width > kLongest) --side;
  return side;
}

/// How many rows of an image are drawn at once. What the driver keeps of their samples, some 50
/// bytes each, is used again for the next rows and fits into a cache: with 2^17 samples an image of
/// 2400 x 1800 takes 0.8 s of processor time and 138 MiB; at once 1.3 s and 800 MiB; with 2^15 1.2
/// s.
int rows_of_strip(const SceneRequest& request, int side) {
  constexpr std::int64_t kSamples = std::int64_t{1} << 17;
  const std::int64_t of_row = std::int64_t{side} * side * request.width;
  const std::int64_t most = std::min(request.height, kLongest / side);
  return static_cast<int>(std::clamp<std::int64_t>(kSamples / of_row, 1, most));
}

/// The mean of `side` x `side` samples, the first of the lowest row at `first`, in about linear
/// light (a gamma of 2), in which thin lines keep their weight.
std::uint32_t mean_of(const unsigned char* first, vtkIdType row_bytes, int side) {
  const float share = 1.0F / static_cast<float>(side * side);
  std::uint32_t mean = 0;
  for (vtkIdType c = 0; c < 3; ++c) {
    std::uint32_t sum = 0;
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const std::uint32_t sample = first[row_bytes * i + 3 * j + c];
        sum += sample * sample;
      }
    mean =
        mean << 8 | static_cast<std::uint32_t>(std::sqrt(share * static_cast<float>(sum)) + 0.5F);
  }
  return mean;
}

/// The rows of an image from `top` on, of samples whose lowest row is the first, as in OpenGL; rows
/// below the image are left out. Each pixel is the mean of `side` x `side` samples.
void take_rows(vtkUnsignedCharArray* samples, int top, int rows, int side, Image& image) {
  const auto row_bytes = static_cast<vtkIdType>(3) * side * image.width;
  const unsigned char* all = samples->GetPointer(0);
  for (int y = top; y < std::min(top + rows, image.height); ++y) {
    const unsigned char* first = all + row_bytes * side * (top + rows - 1 - y);
    std::uint32_t* row = image.row(y);
    if (side == 1)
      for (int x = 0; x < image.width; ++x, first += 3)
        row[x] = static_cast<std::uint32_t>(first[0]) << 16 | first[1] << 8 | first[2];
    else
      for (int x = 0; x < image.width; ++x, first += 3 * side)
        row[x] = mean_of(first, row_bytes, side);
  }
}

/// The projection of a camera to a strip of its image, which is `height` pixels high: the rows from
/// `top` on.
vtkSmartPointer<vtkMatrix4x4> projection_of_strip(vtkCamera* camera, double aspect, int height,
                                                  int top, int rows) {
  auto projection = vtkSmartPointer<vtkMatrix4x4>::New();
  projection->DeepCopy(camera->GetProjectionTransformMatrix(aspect, -1.0, 1.0));
  // Heights in the image run from -1 to 1, upwards.
  const double stretch = static_cast<double>(height) / rows;
  const double middle = 1.0 - (2.0 * top + rows) / height;
  for (int column = 0; column < 4; ++column)
    projection->SetElement(
        1, column,
        stretch * (projection->GetElement(1, column) - middle * projection->GetElement(3, column)));
  return projection;
}

}  // namespace

/// The last scene with the computed light of its views, to be drawn again in other colours.
struct LitScene {
  Scene scene;
  std::map<std::size_t, std::optional<KeptLight>> views = {};
};

struct SceneRenderer::Parts {
  vtkNew<ErrorLog> log;
  vtkSmartPointer<vtkRenderWindow> window;
  std::optional<LitScene> lit;

  /// The light of a view; null if it has none.
  KeptLight* light_of(const Scene& scene, std::size_t view) {
    if (!lit || !(lit->scene == scene)) lit.emplace(LitScene{scene});
    const auto [found, is_new] = lit->views.try_emplace(view);
    if (is_new)
      if (auto light = BakedLight::of(scene, scene.views[view]))
        found->second.emplace(*std::move(light));
    return found->second ? &*found->second : nullptr;
  }

  void throw_what_was_logged() {
    if (!log->errors.empty())
      throw std::runtime_error("VTK: " + one_line(std::exchange(log->errors, {})));
  }
};

void pin_driver() {
  // Variables that change no pixel.
  constexpr std::array kKept = {"HOME",
                                "XDG_CACHE_HOME",
                                "PATH",
                                "TMPDIR",
                                "LD_LIBRARY_PATH",
                                "LP_NUM_THREADS",
                                "MESA_SHADER_CACHE_DISABLE",
                                "MESA_SHADER_CACHE_DIR",
                                "MESA_SHADER_CACHE_MAX_SIZE"};
  std::vector<std::pair<const char*, std::string>> kept;
  for (const char* name : kKept)
    if (const char* value = std::getenv(name)) kept.emplace_back(name, value);
  ::clearenv();
  for (const auto& [name, value] : kept) ::setenv(name, value.c_str(), 1);
  ::setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  ::setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
  // Keeps EGL from every graphics card.
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  constexpr const char* kMesaOfEgl = "/usr/share/glvnd/egl_vendor.d/50_mesa.json";
  if (::access(kMesaOfEgl, R_OK) == 0) ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", kMesaOfEgl, 1);
}

SceneRenderer::SceneRenderer() : parts_(std::make_unique<Parts>()) {
  vtkOutputWindow::SetInstance(parts_->log);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  parts_->window = make_window();
  parts_->throw_what_was_logged();
  const std::string driver = capability(parts_->window, kDriver);
  if (!driver.starts_with("llvmpipe"))
    throw std::runtime_error("OpenGL is drawn by " + driver + ", not by llvmpipe");
}

SceneRenderer::~SceneRenderer() = default;

std::string SceneRenderer::name() const {
  return fmt::format("VTK {}, OpenGL {}, {}", vtkVersion::GetVTKVersion(),
                     capability(parts_->window, kVersion), capability(parts_->window, kDriver));
}

Image SceneRenderer::draw(const Scene& scene, const SceneRequest& request) {
  if (request.view >= scene.views.size()) throw InvalidInput("there is no such view");
  const Shot& view = scene.views[request.view];
  vtkNew<vtkRenderer> renderer;
  const Colour paper = request.background;
  renderer->SetBackground(paper.red / 255.0, paper.green / 255.0, paper.blue / 255.0);
  add_lights(scene, renderer);
  Paint paint{request, view.camera.eye, parts_->light_of(scene, request.view)};
  if (paint.light != nullptr) renderer->AddViewProp(shadow_prop(*paint.light, paper));
  for (paint.part = 0; paint.part < scene.parts.size(); ++paint.part)
    if (shows(view, paint.part))
      for (const auto& prop : props_of(scene.parts[paint.part], paint)) renderer->AddViewProp(prop);
  set_camera(view.camera, renderer->GetActiveCamera());
  renderer->ResetCameraClippingRange();

  vtkRenderWindow* window = parts_->window;
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  // Each sample is shaded: llvmpipe's own multisampling takes twice as long for as many samples.
  const int side = side_samples(request);
  const int rows = rows_of_strip(request, side);
  window->SetSize(side * request.width, side * rows);
  vtkCamera* camera = renderer->GetActiveCamera();
  Image image{request.width, request.height,
              std::vector<std::uint32_t>(static_cast<std::size_t>(request.width) *
                                         static_cast<std::size_t>(request.height))};
  const double aspect = static_cast<double>(request.width) / request.height;
  vtkNew<vtkUnsignedCharArray> samples;
  for (int top = 0; top < request.height; top += rows) {
    camera->SetUseExplicitProjectionTransformMatrix(false);
    const auto projection = projection_of_strip(camera, aspect, request.height, top, rows);
    camera->SetExplicitProjectionTransformMatrix(projection);
    camera->SetUseExplicitProjectionTransformMatrix(true);
    window->Render();
    window->GetPixelData(0, 0, side * request.width - 1, side * rows - 1, 0, samples);
    take_rows(samples, top, rows, side, image);
  }
  window->RemoveRenderer(renderer);
  parts_->throw_what_was_logged();
  return image;
}

}  // namespace mapproof
