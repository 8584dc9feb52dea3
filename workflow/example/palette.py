"""Chooses the colours of tissues: those in the file, or colours that differ between tissues that touch."""
import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

OTHERS = 200  # grey level of labels without a colour


def from_oklch(lightness, chroma, hue):
    """Converts OKLCh colours (B. Ottosson, 2020) to sRGB from 0 to 1; `hue` is in turns."""
    a, b = chroma * np.cos(2 * np.pi * hue), chroma * np.sin(2 * np.pi * hue)
    lms = np.stack([lightness + 0.3963377774 * a + 0.2158037573 * b,
                    lightness - 0.1055613458 * a - 0.0638541728 * b,
                    lightness - 0.0894841775 * a - 1.2914855480 * b], axis=-1) ** 3
    linear = np.clip(lms @ np.transpose([[4.0767416621, -3.3077115913, 0.2309699292],
                                         [-1.2684380046, 2.6097574011, -0.3413193965],
                                         [-0.0041960863, -0.7034186147, 1.7076147010]]), 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def candidates():
    """Returns the colours to choose from, in OKLab (n, 3) and in sRGB (n, 3): nine hues at three lightnesses, without
    the reds, which are reserved for the child mesh."""
    lightness, hue = (x.ravel() for x in np.meshgrid([0.60, 0.74, 0.88], np.linspace(0.17, 0.97, 9)))
    chroma = np.full(len(hue), 0.105)
    lab = np.column_stack([lightness, chroma * np.cos(2 * np.pi * hue), chroma * np.sin(2 * np.pi * hue)])
    return lab, from_oklch(lightness, chroma, hue)


def neighbours_of(pairs):
    """Maps each label to the labels that it shares faces with; tissues with many faces come first. `pairs` is the array
    BoundaryLabels (n, 2)."""
    pairs = np.sort(pairs, axis=1)
    labels, faces = np.unique(pairs[pairs > 0], return_counts=True)
    neighbours = {int(label): set() for label in labels[np.argsort(-faces, kind="stable")]}
    for low, high in np.unique(pairs[pairs[:, 0] > 0], axis=0):
        neighbours[int(low)].add(int(high))
        neighbours[int(high)].add(int(low))
    return neighbours


def told_apart(pairs):
    """Maps each label to sRGB bytes. Each tissue in turn gets a colour that is far from those of its neighbours and
    that few tissues have so far."""
    lab, rgb = candidates()
    uses, chosen = np.zeros(len(lab)), {}
    for label, others in neighbours_of(pairs).items():
        taken = [chosen[other] for other in others if other in chosen]
        distance = np.linalg.norm(lab[:, None] - lab[taken], axis=-1).min(axis=1) if taken else np.ones(len(lab))
        chosen[label] = int(np.argmin(uses - 40 * np.minimum(distance, 0.2)))
        uses[chosen[label]] += 1
    return {label: np.rint(255 * rgb[n]).astype(np.uint8) for label, n in chosen.items()}


def tissue_colors(dataset, pairs):
    """Returns a table (largest label + 1, 3) of sRGB bytes: the file's colours, or those of `told_apart` if the file
    has the same colour for all tissues."""
    fields = dataset.GetFieldData()
    ids, colors = vtk_to_numpy(fields.GetArray("TissueIds")), vtk_to_numpy(fields.GetArray("TissueColors"))
    table = np.full((max(ids.max(), pairs.max()) + 1, 3), OTHERS, np.uint8)
    if len(ids) > 1 and np.all(colors == colors[0]):
        for label, color in told_apart(pairs).items():
            table[label] = color
    else:
        table[ids] = np.rint(255 * (colors / 255 if colors.max() > 1 else colors))
    return table


def tissue_names(dataset):
    """Maps each label to the name of its tissue in the file."""
    fields = dataset.GetFieldData()
    names = fields.GetAbstractArray("TissueNames")
    return {int(label): names.GetValue(n) for n, label in enumerate(vtk_to_numpy(fields.GetArray("TissueIds")))}
