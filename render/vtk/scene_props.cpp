#include "render/vtk/scene_props.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkContourFilter.h>
#include <vtkDelaunay2D.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkStripper.h>
#include <vtkTexture.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/theme/palette.hpp"

namespace mapproof {
namespace {

constexpr int kSides = 24;  // Of the polygon that stands for a circle.
constexpr int kTubeSides = 12;
constexpr double kAmbient = 0.42;  // White stays near white where no light falls.
constexpr double kDiffuse = 0.58;

bool is_dark(Colour ground) {
  return contrast(ground, Colour{}) < contrast(ground, colour(0xFFFFFF));
}

/// On a dark ground pale colours are less pale: a floor of 0.12 has a contrast of 2.4:1 to the dark
/// end of viridis and of 5.4:1 to its light end, where it would else be as dark as the former.
Colour plain_colour(const Style& style, const SceneRequest& request) {
  constexpr double kLessPale = 0.35;
  const double share = is_dark(request.background) ? std::pow(style.share, kLessPale) : style.share;
  return mix(request.colours[static_cast<std::size_t>(style.colour)], request.background, share);
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

/// Whether the computed light falls on such a part.
bool is_baked(const Style& style, const Paint& paint) {
  return paint.light != nullptr && style.lit && style.opacity >= 1.0;
}

Colour lit_by(double light, Colour colour) {
  constexpr double kBrightest = 1.3, kGamma = 2.2;
  const double factor = std::pow(std::clamp(light, 0.0, kBrightest), 1.0 / kGamma);
  const auto channel = [factor](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::lround(std::min(255.0, factor * value)));
  };
  return {channel(colour.red), channel(colour.green), channel(colour.blue)};
}

/// The mesh in colours that hold the light, unlit.
Props baked_props(const TriangleMesh& mesh, const std::vector<Colour>& colours, Style style,
                  const Paint& paint) {
  ColourList lit;
  const std::vector<double>& light = paint.light->at(paint.part, mesh);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) lit.add(lit_by(light[i], colours[i]));
  style.lit = false;
  return mesh_props(mesh, &lit, style, paint.request);
}

/// Surfaces are seen from both sides: the light is that of the side towards the eye.
Props baked_surface(const Surface& surface, const Paint& paint) {
  constexpr double kLongest = 0.06;  // Of the floor's side, of a triangle's edge.
  TriangleMesh mesh = fine_mesh(surface, kLongest * paint.light->extent());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (mesh.normals[i].dot(paint.eye - mesh.points[i]) < 0.0) mesh.normals[i] *= -1.0;
  const std::vector<Colour> colours(mesh.points.size(), plain_colour(surface.style, paint.request));
  return baked_props(mesh, colours, surface.style, paint);
}

bool is_upright(const Point3& from, const Point3& to) {
  return from.x() == to.x() && from.y() == to.y() && from.z() < to.z();
}

Props baked_rods(const Rods& rods, const Paint& paint) {
  TriangleMesh mesh;
  std::vector<Colour> colours;
  for (std::size_t i = 0; i < rods.from.size(); ++i) {
    const auto add = rods.arrow                             ? add_arrow
                     : is_upright(rods.from[i], rods.to[i]) ? add_pillar
                                                            : add_rod;
    add(mesh, rods.from[i], rods.to[i], rods.radius, kSides);
    colours.resize(mesh.points.size(), toned_colour(rods.style, rods.tones, i, paint.request));
  }
  return baked_props(mesh, colours, rods.style, paint);
}

Props part_props(const Surface& surface, const Paint& paint) {
  const SceneRequest& request = paint.request;
  if (surface.triangles.empty()) return {};
  if (is_baked(surface.style, paint) && !surface.smooth && surface.tones.values.empty())
    return baked_surface(surface, paint);
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

Props part_props(const Tube& tube, const Paint& paint) {
  const SceneRequest& request = paint.request;
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

Props part_props(const Rods& rods, const Paint& paint) {
  if (is_baked(rods.style, paint)) return baked_rods(rods, paint);
  return solid_props(rods.from.size(), rods.style, rods.tones, paint.request,
                     [&rods](TriangleMesh& mesh, std::size_t i) {
                       const auto add = rods.arrow ? add_arrow : add_rod;
                       add(mesh, rods.from[i], rods.to[i], rods.radius, kSides);
                     });
}

Props part_props(const Spheres& spheres, const Paint& paint) {
  return solid_props(spheres.at.size(), spheres.style, spheres.tones, paint.request,
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
Props part_props(const Field& field, const Paint& paint) {
  const SceneRequest& request = paint.request;
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

}  // namespace

Props props_of(const Part& part, const Paint& paint) {
  return std::visit([&paint](const auto& one) { return part_props(one, paint); }, part);
}

vtkSmartPointer<vtkProp> shadow_prop(KeptLight& light, Colour background) {
  constexpr Colour kOfCoolSky = colour(0x121A2E);
  constexpr double kLift = 1e-3;  // Above the floor, of its side.
  // On a dark floor the sky's colour would be no shadow.
  const Colour dark = is_dark(background) ? Colour{} : kOfCoolSky;
  const BakedLight::Shadow& shadow = light.shadow();
  vtkNew<vtkImageData> image;
  image->SetDimensions(shadow.size, shadow.size, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* texel = static_cast<unsigned char*>(image->GetScalarPointer());
  for (const std::uint8_t alpha : shadow.alpha)
    for (const unsigned char channel : {dark.red, dark.green, dark.blue, alpha}) *texel++ = channel;
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->SetColorModeToDirectScalars();
  texture->InterpolateOn();

  std::vector<Point3> corners;
  vtkNew<vtkFloatArray> at;
  at->SetNumberOfComponents(2);
  for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
    corners.push_back(shadow.corner + shadow.side * Point3(u, v, 0.0) +
                      kLift * light.extent() * Point3::UnitZ());
    at->InsertNextTuple2(u, v);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(corners));
  data->SetPolys(cells_of({{0, 1, 2}, {0, 2, 3}}));
  data->GetPointData()->SetTCoords(at);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetTexture(texture);
  actor->GetProperty()->SetLighting(false);
  actor->ForceTranslucentOn();
  return actor;
}

}  // namespace mapproof
