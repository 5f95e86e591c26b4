#include "render/vtk/scene_renderer.hpp"

#include <unistd.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkContourFilter.h>
#include <vtkDelaunay2D.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLight.h>
#include <vtkLogger.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProp.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkStripper.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVersion.h>
#include <vtkVersionMacros.h>
#include <vtk_glew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/scene_request.hpp"
#include "render/theme/palette.hpp"
#include "render/vtk/gl_context.hpp"

namespace mapproof {
namespace {

using Props = std::vector<vtkSmartPointer<vtkProp>>;

constexpr int kSides = 24;  // Of the polygon that stands for a circle.
constexpr int kTubeSides = 12;
constexpr double kAmbient = 0.42;  // White stays near white where no light falls.
constexpr double kDiffuse = 0.58;

Colour plain_colour(const Style& style, const SceneRequest& request) {
  return mix(request.colours[static_cast<std::size_t>(style.colour)], request.background,
             style.share);
}

/// The colour of the i-th value; the plain colour where there is none.
Colour toned_colour(const Style& style, const Tones& tones, std::size_t i,
                    const SceneRequest& request) {
  if (tones.values.empty() || std::isnan(tones.values[i])) return plain_colour(style, request);
  return viridis((tones.values[i] - tones.limits.low) / (tones.limits.high - tones.limits.low));
}

vtkNew<vtkPoints> points_of(const std::vector<Point3>& positions) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), positions[i].data());
  return points;
}

vtkNew<vtkCellArray> cells_of(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : triangles) {
    const std::array<vtkIdType, 3> corners = {a, b, c};
    cells->InsertNextCell(3, corners.data());
  }
  return cells;
}

class ColourList {
 public:
  ColourList() { list_->SetNumberOfComponents(3); }
  void add(Colour colour, std::size_t times = 1) {
    for (; times > 0; --times) list_->InsertNextTuple3(colour.red, colour.green, colour.blue);
  }
  vtkUnsignedCharArray* get() { return list_; }

 private:
  vtkNew<vtkUnsignedCharArray> list_;
};

vtkSmartPointer<vtkActor> actor_of(vtkPolyDataMapper* mapper, const Style& style,
                                   const SceneRequest& request) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  const Colour colour = plain_colour(style, request);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
  property->SetOpacity(style.opacity);
  property->SetLighting(style.lit);
  property->SetAmbient(kAmbient);
  property->SetDiffuse(kDiffuse);
  property->SetSpecular(0.0);
  return actor;
}

/// Points have the colours of `data`, if it has any.
vtkSmartPointer<vtkActor> actor_of(vtkPolyData* data, const Style& style,
                                   const SceneRequest& request) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarVisibility(data->GetPointData()->GetScalars() != nullptr);
  return actor_of(mapper, style, request);
}

Props mesh_props(const TriangleMesh& mesh, ColourList* colours, const Style& style,
                 const SceneRequest& request) {
  if (mesh.triangles.empty()) return {};
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(mesh.points));
  data->SetPolys(cells_of(mesh.triangles));
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const Point3& n : mesh.normals) normals->InsertNextTuple3(n.x(), n.y(), n.z());
  data->GetPointData()->SetNormals(normals);
  if (colours != nullptr) data->GetPointData()->SetScalars(colours->get());
  return {actor_of(data, style, request)};
}

/// One mesh of `count` solids, each in the colour of its value.
template <typename AddOne>
Props solid_props(std::size_t count, const Style& style, const Tones& tones,
                  const SceneRequest& request, AddOne add_one) {
  TriangleMesh mesh;
  ColourList colours;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = mesh.points.size();
    add_one(mesh, i);
    colours.add(toned_colour(style, tones, i, request), mesh.points.size() - before);
  }
  return mesh_props(mesh, tones.values.empty() ? nullptr : &colours, style, request);
}

Props part_props(const Surface& surface, const SceneRequest& request) {
  if (surface.triangles.empty()) return {};
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(surface.points));
  data->SetPolys(cells_of(surface.triangles));
  ColourList colours;
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    colours.add(toned_colour(surface.style, surface.tones, i, request));
  if (!surface.tones.values.empty()) data->GetPointData()->SetScalars(colours.get());
  if (!surface.smooth) {
    const auto actor = actor_of(data, surface.style, request);
    actor->GetProperty()->SetInterpolationToFlat();
    return {actor};
  }
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SplittingOff();
  normals->Update();
  return {actor_of(normals->GetOutput(), surface.style, request)};
}

Props part_props(const Tube& tube, const SceneRequest& request) {
  std::vector<Point3> positions;
  ColourList colours;
  for (std::size_t i = 0; i < tube.points.size(); ++i) {
    if (!positions.empty() && (tube.points[i] - positions.back()).norm() < 1e-9 * tube.radius)
      continue;
    positions.push_back(tube.points[i]);
    colours.add(toned_colour(tube.style, tube.tones, i, request));
  }
  if (positions.size() < 2) return {};
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(positions));
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
    lines->InsertCellPoint(static_cast<vtkIdType>(i));
  data->SetLines(lines);
  if (!tube.tones.values.empty()) data->GetPointData()->SetScalars(colours.get());
  vtkNew<vtkTubeFilter> filter;
  filter->SetInputData(data);
  filter->SetRadius(tube.radius);
  filter->SetNumberOfSides(kTubeSides);
  filter->CappingOn();
  filter->Update();
  return {actor_of(filter->GetOutput(), tube.style, request)};
}

Props part_props(const Rods& rods, const SceneRequest& request) {
  return solid_props(rods.from.size(), rods.style, rods.tones, request,
                     [&rods](TriangleMesh& mesh, std::size_t i) {
                       const auto add = rods.arrow ? add_arrow : add_rod;
                       add(mesh, rods.from[i], rods.to[i], rods.radius, kSides);
                     });
}

Props part_props(const Spheres& spheres, const SceneRequest& request) {
  return solid_props(spheres.at.size(), spheres.style, spheres.tones, request,
                     [&spheres](TriangleMesh& mesh, std::size_t i) {
                       add_sphere(mesh, spheres.at[i], spheres.radius, kSides);
                     });
}

vtkNew<vtkLookupTable> viridis_table(const Range& limits) {
  constexpr int kColours = 256;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(kColours);
  table->SetRange(limits.low, limits.high);
  for (int i = 0; i < kColours; ++i) {
    const Colour c = viridis(static_cast<double>(i) / (kColours - 1));
    table->SetTableValue(i, c.red / 255.0, c.green / 255.0, c.blue / 255.0);
  }
  return table;
}

vtkSmartPointer<vtkProp> contour_prop(const Field& field, vtkPolyData* surface,
                                      const SceneRequest& request) {
  vtkNew<vtkContourFilter> contours;
  contours->SetInputData(surface);
  for (std::size_t i = 0; i < field.levels.size(); ++i)
    contours->SetValue(static_cast<int>(i), field.levels[i]);
  vtkNew<vtkStripper> joined;
  joined->SetInputConnection(contours->GetOutputPort());
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputConnection(joined->GetOutputPort());
  tubes->SetRadius(field.contour_radius);
  tubes->SetNumberOfSides(kTubeSides);
  tubes->CappingOn();
  tubes->Update();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(tubes->GetOutput());
  mapper->ScalarVisibilityOff();
  return actor_of(mapper, {.colour = ThemeColour::kText, .lit = false}, request);
}

/// Values are interpolated before they are coloured, so that a triangle shows the colours of the
/// ramp and not a mixture of those at its corners.
Props part_props(const Field& field, const SceneRequest& request) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(field.points));
  vtkNew<vtkDoubleArray> values;
  for (const double value : field.tones.values) values->InsertNextValue(value);
  data->GetPointData()->SetScalars(values);
  vtkNew<vtkDelaunay2D> plan;
  plan->SetInputData(data);
  plan->Update();
  vtkPolyData* surface = plan->GetOutput();
  if (surface->GetNumberOfPolys() == 0) return {};
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetLookupTable(viridis_table(field.tones.limits));
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  Props props = {actor_of(mapper, field.style, request)};
  if (!field.levels.empty()) props.push_back(contour_prop(field, surface, request));
  return props;
}

/// The VTK props of a part, in the colours of the request; none for an empty part.
Props props_of(const Part& part, const SceneRequest& request) {
  return std::visit([&request](const auto& one) { return part_props(one, request); }, part);
}

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

/// Samples along each side of a pixel, fewer than requested where the whole image would be too
/// large for the driver.
int side_samples(const SceneRequest& request) {
  constexpr int kLongest = 16384;                        // The limit of llvmpipe.
  constexpr std::int64_t kMost = std::int64_t{1} << 27;  // Some 2 GiB with depth and copies.
  int side = 1;
  while (side * side < request.samples) ++side;
  const std::int64_t pixels = std::int64_t{request.width} * request.height;
  while (side > 1 && (side * std::max(request.width, request.height) > kLongest ||
                      side * side * pixels > kMost))
    --side;
  return side;
}

/// The mean of `side` x `side` samples, the first of the lowest row at `first`.
std::uint32_t mean_of(const unsigned char* first, vtkIdType row_bytes, int side) {
  const auto count = static_cast<std::uint32_t>(side * side);
  std::array<std::uint32_t, 3> sum{count / 2, count / 2, count / 2};
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += first[row_bytes * i + 3 * j + static_cast<vtkIdType>(c)];
  return sum[0] / count << 16 | sum[1] / count << 8 | sum[2] / count;
}

/// An image of samples whose lowest row is the first, as in OpenGL. Each pixel is the mean of
/// `side` x `side` samples.
Image image_of(vtkUnsignedCharArray* bytes, int width, int height, int side) {
  Image image{width, height, std::vector<std::uint32_t>(static_cast<std::size_t>(width) * height)};
  const auto row_bytes = static_cast<vtkIdType>(3) * side * width;
  const unsigned char* all = bytes->GetPointer(0);
  for (int y = 0; y < height; ++y) {
    const unsigned char* first = all + row_bytes * side * (height - 1 - y);
    std::uint32_t* row = image.row(y);
    if (side == 1)
      for (int x = 0; x < width; ++x, first += 3)
        row[x] = static_cast<std::uint32_t>(first[0]) << 16 | first[1] << 8 | first[2];
    else
      for (int x = 0; x < width; ++x, first += 3 * side) row[x] = mean_of(first, row_bytes, side);
  }
  return image;
}

}  // namespace

struct SceneRenderer::Parts {
  vtkNew<ErrorLog> log;
  vtkSmartPointer<vtkRenderWindow> window;

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
  for (std::size_t i = 0; i < scene.parts.size(); ++i)
    if (shows(view, i))
      for (const auto& prop : props_of(scene.parts[i], request)) renderer->AddViewProp(prop);
  set_camera(view.camera, renderer->GetActiveCamera());
  renderer->ResetCameraClippingRange();

  vtkRenderWindow* window = parts_->window;
  // Each sample is shaded: llvmpipe's own multisampling takes twice as long for as many samples.
  const int side = side_samples(request);
  const int width = side * request.width, height = side * request.height;
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, width - 1, height - 1, 0, bytes);
  window->RemoveRenderer(renderer);
  parts_->throw_what_was_logged();
  return image_of(bytes, request.width, request.height, side);
}

}  // namespace mapproof
