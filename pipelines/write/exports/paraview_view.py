"""Shows the bodies of a run in ParaView: largest von Mises stress over the cycle, each body in a view of its own.

    paraview --script=paraview_view.py           looks at them
    pvpython paraview_view.py stress.png         makes a picture

Colours reach to the largest stress outside what is left out beside sharp edges, which is drawn pale. The cycle is in
the pipeline of each body, hidden, with its displacement magnified.
"""
import glob
import json
import os
import sys

import paraview.simple as pv

STRESS = "von Mises stress, maximum [MPa]"
# From light to dark: shape shows where stress is low.
COLOURS = ["f4f1e4", "ffeda0", "fed976", "feb24c", "fd8d3c", "fc4e2a", "e31a1c", "bd0026", "7a0022"]
INK = [0.1, 0.1, 0.1]
FOLDER = os.path.dirname(os.path.abspath(globals().get("__file__", "paraview_view.py")))


def paler_where_left_out(display):
    display.UseSeparateOpacityArray = 1
    display.OpacityArray = ["POINTS", "left_out"]
    display.OpacityTransferFunction.Points = [0, 1, 0.5, 0, 1, 0.3, 0.5, 0]


def colour(display, view, largest):
    pv.ColorBy(display, ("POINTS", STRESS), separate=True)
    table = pv.GetColorTransferFunction(STRESS, display, separate=True)
    table.ColorSpace = "RGB"
    table.RGBPoints = [
        number
        for i, colour in enumerate(COLOURS)
        for number in (largest * i / (len(COLOURS) - 1), *(int(colour[c : c + 2], 16) / 255 for c in (0, 2, 4)))
    ]
    display.SetScalarBarVisibility(view, True)
    bar = pv.GetScalarBar(table, view)
    bar.TitleColor = bar.LabelColor = INK
    bar.ComponentTitle = ""


def look(view, bounds, place):
    """y up, a little from above, from the quarter in which the place is."""
    centre = [(bounds[2 * d] + bounds[2 * d + 1]) / 2 for d in range(3)]
    side = [size_of(bounds) if place[d] >= centre[d] else -size_of(bounds) for d in range(3)]
    view.CameraFocalPoint = centre
    view.CameraPosition = [centre[0] + 1.6 * side[0], centre[1] + 0.9 * size_of(bounds), centre[2] + 1.2 * side[2]]
    view.CameraViewUp = [0, 1, 0]
    view.ResetCamera(True)


def size_of(bounds):
    return max(bounds[2 * d + 1] - bounds[2 * d] for d in range(3))


def mark(name, view, governing, size):
    place = pv.Sphere(
        registrationName=name + ", governing place", Center=governing["position_m"], Radius=0.01 * size
    )
    display = pv.Show(place, view)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = display.AmbientColor = [0, 0.45, 0.7]
    text = pv.Text(
        registrationName=name + ", governing stress",
        Text=f"{name}: {governing['name']} {governing['value'] / 1e6:.4g} MPa (blue)\n{governing['feature']}",
    )
    shown = pv.Show(text, view)
    shown.Color = INK
    shown.FontSize = 14


def add_cycle(name, view, size):
    snapshots = os.path.join(FOLDER, name, "cycle.pvd")
    if not os.path.exists(snapshots):
        return
    cycle = pv.PVDReader(registrationName=name + ", cycle", FileName=snapshots)
    moved = pv.WarpByVector(registrationName=name + ", moved", Input=cycle, Vectors=["POINTS", "displacement [m]"])
    cycle.UpdatePipeline()
    largest = cycle.PointData["displacement [m]"].GetRange(-1)[1]
    moved.ScaleFactor = 0.05 * size / largest if largest > 0 else 1
    pv.Hide(cycle, view)
    pv.Hide(moved, view)


def show_body(name, figures, view):
    files = glob.glob(os.path.join(glob.escape(os.path.join(FOLDER, name)), "envelope.*vtu"))
    body = pv.OpenDataFile(files[0], registrationName=name)
    display = pv.Show(body, view)
    display.NonlinearSubdivisionLevel = 2
    colour(display, view, figures["peak_von_mises"]["value"] / 1e6)
    paler_where_left_out(display)
    bounds = body.GetDataInformation().GetBounds()
    mark(name, view, figures["governing"], size_of(bounds))
    add_cycle(name, view, size_of(bounds))
    look(view, bounds, figures["governing"]["position_m"])


def main():
    with open(os.path.join(FOLDER, "summary.json"), encoding="utf-8") as file:
        bodies = json.load(file)["bodies"]
    layout = pv.CreateLayout("stress")
    place = 0
    for i, (name, figures) in enumerate(bodies.items()):
        view = pv.CreateRenderView()
        view.UseColorPaletteForBackground = 0
        view.Background = [1, 1, 1]
        view.OrientationAxesLabelColor = INK
        if i > 0:
            place = layout.SplitVertical(place, 1 / (len(bodies) - i + 1)) + 1
        layout.AssignView(place, view)
        show_body(name, figures, view)
    for picture in sys.argv[1:]:
        layout.SetSize(1600, 1000)
        pv.RenderAllViews()
        pv.SaveScreenshot(picture, layout)


main()
