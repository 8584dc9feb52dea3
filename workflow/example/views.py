"""Draws meshes by VTK in parallel projection, and annotates the pictures."""
import numpy as np
import vtk
from PIL import Image
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SUPERSAMPLING = 2
MARGIN = 26  # pixels around what is shown
INK = "#22262e"
FOCUS_COLOR = "#c8102e"
EDGE_COLOR = (0.2, 0.22, 0.26)


def save_image(image, file, palette=False):
    """Saves an image as a small PNG, without dithering: with 64 levels per channel, which halves the size and cannot be
    seen, or with a palette of 256 colours, which is much smaller still and suffices for meshes of many tissues."""
    levels = [min(255, 4 * round(value / 4)) for value in range(256)]
    image = image.convert("RGB")
    if palette:
        image = image.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    else:
        image = image.point(levels * 3)
    image.save(file, optimize=True)


def unit(vector):
    return np.asarray(vector, float) / np.linalg.norm(vector)


def paint(dataset, colors):
    dataset.GetCellData().SetScalars(numpy_to_vtk(np.ascontiguousarray(colors), deep=True))


def extracted(dataset, keep):
    """Returns the cells for which `keep` is true, uncut."""
    ids = vtk.vtkIdList()
    for cell in np.flatnonzero(keep):
        ids.InsertNextId(int(cell))
    extract = vtk.vtkExtractCells()
    extract.SetInputData(dataset)
    extract.SetCellList(ids)
    extract.Update()
    return extract.GetOutput()


def cell_centers(dataset):
    centers = vtk.vtkCellCenters()
    centers.SetInputData(dataset)
    centers.VertexCellsOff()
    centers.Update()
    return vtk_to_numpy(centers.GetOutput().GetPoints().GetData())


def actor_of(dataset, edge_width=0.0, color=None):
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(dataset)
    surface.Update()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(surface.GetOutput())
    mapper.SetScalarVisibility(color is None)
    mapper.SetColorModeToDirectScalars()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetInterpolationToFlat()
    look.SetAmbient(0.4)
    look.SetDiffuse(0.65)
    if color:
        look.SetColor(color)
    if edge_width:
        look.EdgeVisibilityOn()
        look.SetEdgeColor(EDGE_COLOR)
        look.SetLineWidth(edge_width * SUPERSAMPLING)
    return actor


def lines_of(dataset, width):
    actor = actor_of(dataset, color=(0.13, 0.15, 0.18))
    actor.GetProperty().SetLineWidth(width * SUPERSAMPLING)
    actor.GetProperty().LightingOff()
    return actor


class View:
    """A view of `actors` along `direction` (LPS), with the cranial side up. All actors and the points `also` just fit
    into `size` (width, height) pixels. `image` is the picture."""

    def __init__(self, actors, direction, size, also=()):
        direction = unit(direction)
        right = unit(np.cross(direction, (0, 0, 1)))
        self.frame = np.stack([right, np.cross(right, direction), direction])
        self.size = size
        data = [actor.GetMapper().GetInput().GetPoints() for actor in actors]
        data = [vtk_to_numpy(points.GetData()) for points in data if points is not None and points.GetNumberOfPoints()]
        corners = np.concatenate([*data, *[np.reshape(point, (1, 3)) for point in also]]) @ self.frame.T
        low, high = corners.min(axis=0), corners.max(axis=0)
        self.focus = (low + high) / 2
        self.mm_per_pixel = max(((high - low)[:2] / (np.array(size) - 2 * MARGIN)).max(), 1e-6)
        self.image = self.rendered(actors)

    def rendered(self, actors):
        renderer = vtk.vtkRenderer()
        renderer.SetBackground(1, 1, 1)
        for actor in actors:
            renderer.AddActor(actor)
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(self.focus @ self.frame)
        camera.SetPosition(self.focus @ self.frame - 1000 * self.frame[2])
        camera.SetViewUp(self.frame[1])
        camera.SetParallelScale(self.mm_per_pixel * self.size[1] / 2)
        renderer.ResetCameraClippingRange()
        window = vtk.vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize([SUPERSAMPLING * n for n in self.size])
        window.AddRenderer(renderer)
        window.Render()
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.ReadFrontBufferOff()
        grab.Update()
        width, height, _ = grab.GetOutput().GetDimensions()
        pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(height, width, 3)[::-1]
        return Image.fromarray(pixels).resize(self.size, Image.BOX)

    def pixels(self, positions):
        """Returns the pixels (n, 2) at positions (n, 3) in LPS mm, counted from the lower left corner of the image."""
        seen = np.reshape(positions, (-1, 3)) @ self.frame.T - self.focus
        return seen[:, :2] / self.mm_per_pixel + np.array(self.size) / 2


def side_letters(right):
    """Returns the two letters of the patient's sides at the left and right edge of a picture whose x axis points to
    `right` (LPS)."""
    axis = int(np.abs(right[:2]).argmax())
    letters = ("RL", "AP")[axis]
    return letters if right[axis] > 0 else letters[::-1]


def round_length(length):
    """Returns the largest of 1, 2 and 5 times a power of ten that is not longer than `length`."""
    power = 10.0 ** np.floor(np.log10(length))
    return max(factor * power for factor in (1, 2, 5) if factor * power <= length * (1 + 1e-9))


def put(figure, view, x, y):
    """Shows a view with its lower left corner at pixel (x, y) of the figure, with a scale bar and the letters of the
    patient's sides. Returns axes over the picture whose units are the view's pixels."""
    width, height = view.size
    full = figure.get_size_inches() * figure.dpi
    axes = figure.add_axes((x / full[0], y / full[1], width / full[0], height / full[1]))
    axes.imshow(view.image, extent=(0, width, 0, height), interpolation="none", aspect="auto")
    axes.set(xlim=(0, width), ylim=(0, height))
    axes.axis("off")
    length = round_length(view.mm_per_pixel * width / 5)
    bar = length / view.mm_per_pixel
    axes.plot([width - 8 - bar, width - 8], [8, 8], color=INK, linewidth=4, solid_capstyle="butt")
    axes.text(width - 8 - bar / 2, 14, f"{length:g} mm", ha="center", va="bottom", fontsize=13, color=INK)
    for letter, at, side in zip(side_letters(view.frame[0]), (4, width - 4), ("left", "right")):
        axes.text(at, height - 4, letter, ha=side, va="top", fontsize=20, weight="bold", color=INK)
    return axes


def mark(axes, view, position, toward=None):
    """Draws a red cross at a position and, if `toward` is given, a dashed line from there to `toward` (all LPS mm)."""
    x, y = view.pixels(position)[0]
    if toward is not None:
        ends = np.stack([view.pixels(toward)[0], (x, y)])
        axes.plot(*ends.T, color=FOCUS_COLOR, linewidth=1.5, linestyle=(0, (4, 3)))
    for color, width in (("white", 6), (FOCUS_COLOR, 3)):
        axes.plot(x, y, "+", color=color, markersize=20, markeredgewidth=width)
