"""Draws the scene of scenes_bench.cpp by VTK's own sources and windows.

scenes_vtk.py FOLDER SAMPLES COUNT SINCE    as mapproof_scenes_bench draw; prints
"python-vtk SAMPLES FIRST_S FURTHER_S". Needs a display (Xvfb will do).
"""

import json
import math
import sys
import time

import vtkmodules.vtkInteractionStyle  # noqa: F401  (registers nothing that is drawn)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkArrowSource, vtkLineSource
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderWindow, vtkRenderer, vtkWindowToImageFilter)

COLOURS = {"series1": (0.0, 0.45, 0.70), "series2": (0.84, 0.37, 0.0), "text": (0.1, 0.1, 0.1),
        "muted": (0.5, 0.5, 0.5)}


def polydata(points, polys=(), lines=()):
    data, places, faces, strips = vtkPolyData(), vtkPoints(), vtkCellArray(), vtkCellArray()
    for point in points:
        places.InsertNextPoint(point)
    for cells, into in ((polys, faces), (lines, strips)):
        for cell in cells:
            into.InsertNextCell(len(cell))
            for corner in cell:
                into.InsertCellPoint(corner)
    data.SetPoints(places)
    data.SetPolys(faces)
    data.SetLines(strips)
    return data


def tube(data, radius, sides):
    tubes = vtkTubeFilter()
    tubes.SetInputData(data)
    tubes.SetRadius(radius)
    tubes.SetNumberOfSides(sides)
    tubes.CappingOn()
    return tubes


def arrow(start, end, radius):
    direction = [b - a for a, b in zip(start, end)]
    length = math.sqrt(sum(d * d for d in direction))
    source = vtkArrowSource()
    source.SetShaftRadius(radius / length)
    source.SetTipRadius(3 * radius / length)
    source.SetTipLength(min(1.0, 4 * radius / length))
    source.SetShaftResolution(24)
    source.SetTipResolution(24)
    transform = vtkTransform()
    transform.Translate(start)
    transform.RotateZ(math.degrees(math.atan2(direction[1], direction[0])))
    transform.RotateY(-math.degrees(math.asin(direction[2] / length)))
    transform.Scale(length, length, length)
    placed = vtkTransformPolyDataFilter()
    placed.SetInputConnection(source.GetOutputPort())
    placed.SetTransform(transform)
    return placed


def output(source):
    source.Update()
    return source.GetOutput()


def shape_of(part):
    kind = part["kind"]
    if kind == "surface":
        return None, polydata(part["points"], polys=part["triangles"])
    if kind == "tube":
        points = part["points"]
        data = polydata(points, lines=[range(len(points))])
        colours = vtkUnsignedCharArray()
        colours.SetNumberOfComponents(3)
        for i in range(len(points)):
            share = i / len(points)
            colours.InsertNextTuple3(int(70 + 180 * share), int(230 * share), 90)
        data.GetPointData().SetScalars(colours)
        return tube(data, part["radius"], 12), None
    together = vtkAppendPolyData()
    for start, end in zip(part["from"], part["to"]):
        if start == end:
            continue
        if part["arrow"]:
            together.AddInputData(output(arrow(start, end, part["radius"])))
            continue
        line = vtkLineSource()
        line.SetPoint1(start)
        line.SetPoint2(end)
        line.Update()
        together.AddInputData(output(tube(line.GetOutput(), part["radius"], 24)))
    return together, None


def renderer_of(scene):
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for part in scene["parts"]:
        source, data = shape_of(part)
        mapper = vtkPolyDataMapper()
        if source is None:
            mapper.SetInputData(data)
        else:
            mapper.SetInputConnection(source.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(COLOURS.get(part["style"]["colour"], (0.5, 0.5, 0.5)))
        renderer.AddActor(actor)
    renderer.AutomaticLightCreationOff()
    for one in scene["lights"]:
        light = vtkLight()
        light.SetPosition(one["from"])
        light.SetIntensity(one["strength"])
        renderer.AddLight(light)
    camera, seen = renderer.GetActiveCamera(), scene["views"][0]["camera"]
    camera.SetPosition(seen["eye"])
    camera.SetFocalPoint(seen["target"])
    camera.SetViewUp(seen["up"])
    camera.SetViewAngle(math.degrees(seen["angle_rad"]))
    renderer.ResetCameraClippingRange()
    return renderer


def main():
    folder, samples, count, since = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4])
    with open(f"{folder}/scene.json", encoding="utf-8") as file:
        renderer = renderer_of(json.load(file))
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(samples)
    window.SetSize(1200, 900)
    window.AddRenderer(renderer)
    first = 0.0
    for i in range(count):
        window.Render()
        image = vtkWindowToImageFilter()
        image.SetInput(window)
        image.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetFileName(f"{folder}/vtk-{samples}-{i}.png")
        writer.SetInputConnection(image.GetOutputPort())
        writer.Write()
        if i == 0:
            first = time.time() - since
        renderer.GetActiveCamera().Azimuth(math.degrees(0.05))
        renderer.ResetCameraClippingRange()
    further = (time.time() - since - first) / max(count - 1, 1)
    print(f"python-vtk {samples} {first:.4f} {further:.4f}")


main()
