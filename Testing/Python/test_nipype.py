"""nipype generates an interface from a module's --xml, and the interface runs the module on a small real input.

Usage: test_nipype.py MODULE BIN_FOLDER WORK_FOLDER

nipype is used as it comes: generate_class() calls MODULE --xml, found on the path as nipype expects it, and writes the
source of a class whose inputs are the module's parameters. Without nipype the test is skipped (status 77).
"""
import importlib
import json
import os
import re
import shutil
import sys

os.environ["NO_ET"] = "1"  # nipype asks a server for its newest version otherwise
try:
    from nipype.interfaces.slicer.generate_classes import generate_class
    import nibabel
    import numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

IMPORTS = """
import os
from nipype.interfaces.base import (CommandLine, CommandLineInputSpec, SEMLikeCommandLine, TraitedSpec, File, Directory,
                                    traits, isdefined, InputMultiPath, OutputMultiPath)
"""


def interface(module):
    """The class nipype makes of `module`, by the way of a source file as nipype's own generate_all_classes() does."""
    category, source, name = generate_class(module, launcher=[])
    with open(name.lower() + ".py", "w") as file:
        file.write(IMPORTS + source)
    sys.path.insert(0, os.getcwd())
    return getattr(importlib.import_module(name.lower()), name)


def write_label_map():
    """A box of tissue 2 in a box of tissue 1, voxels of 1 x 1 x 1.5 mm."""
    labels = numpy.zeros((24, 24, 18), numpy.uint8)
    labels[4:20, 4:20, 3:15] = 1
    labels[8:16, 8:16, 6:12] = 2
    nibabel.save(nibabel.Nifti1Image(labels, numpy.diag([1, 1, 1.5, 1])), "labels.nii.gz")
    return os.path.abspath("labels.nii.gz")


def write_markups(name, kind, points):
    markup = {
        "type": kind, "coordinateSystem": "LPS", "coordinateUnits": "mm",
        "controlPoints": [{"id": str(i), "position": list(point)} for i, point in enumerate(points)]}
    with open(name, "w") as file:
        json.dump({"markups": [markup]}, file)
    return os.path.abspath(name)


def cells(file, kind, element):
    with open(file, "rb") as stream:
        head = stream.read(4000).decode("latin1")
    assert 'type="%s"' % kind in head, "%s is no %s" % (file, kind)
    return int(re.search(r'%s="\s*(\d+)"' % element, head).group(1))


def run_scale():
    scale = interface("SurgicalPathScaleCLI")()
    scale.inputs.labelMap = write_label_map()
    scale.inputs.targets = [
        write_markups("first.mrk.json", "Fiducial", [(-12, -12, 12)]),
        write_markups("second.mrk.json", "Fiducial", [(-4, -12, 12), (-20, -12, 12)])]
    scale.inputs.path = [write_markups("path.mrk.json", "Curve", [(-12, -2, 12), (-12, -12, 12)])]
    scale.inputs.minimumEdgeLength = 1.5
    scale.inputs.combine = "smaller"
    scale.inputs.threads = 1
    scale.inputs.scale = "scale.nii.gz"
    scale.inputs.report = True
    outputs = scale.run().outputs
    lengths = nibabel.load(outputs.scale).get_fdata()
    assert abs(lengths.min() - 1.5) < 1e-5 and lengths.max() <= 8, (lengths.min(), lengths.max())
    with open(outputs.report) as file:
        json.load(file)


def run_surface():
    mesher = interface("SimplexMesherCLI")()
    mesher.inputs.labelMap = write_label_map()
    mesher.inputs.edgeLength = 2.5
    mesher.inputs.surface = True
    mesher.inputs.preparedLabelMap = "prepared.nii.gz"
    mesher.inputs.report = True
    outputs = mesher.run().outputs
    assert cells(outputs.surface, "PolyData", "NumberOfPolys") > 100
    assert sorted(numpy.unique(nibabel.load(outputs.preparedLabelMap).get_fdata())) == [0, 1, 2]
    with open(outputs.report) as file:
        json.load(file)
    return outputs.surface


def run_mesh():
    tetrahedralizer = interface("FuchsTetrahedralizerCLI")()
    tetrahedralizer.inputs.surface = run_surface()
    tetrahedralizer.inputs.edgeLength = 2.5
    tetrahedralizer.inputs.mesh = True
    outputs = tetrahedralizer.run().outputs
    assert cells(outputs.mesh, "UnstructuredGrid", "NumberOfCells") > 100


def run_test_module():
    module = interface("CommandLineTestModule")()
    module.inputs.input = write_label_map()
    module.inputs.result = True
    module.inputs.list = [module.inputs.input, module.inputs.input]
    module.inputs.on = True
    module.inputs.count = 2
    module.inputs.length = 2.5
    module.inputs.power = "4"
    module.inputs.indices = [3, 4]
    module.inputs.weights = [0.5, 0.25]
    with open(module.run().outputs.result) as file:
        assert file.read() == "hello\nhello\n" + 2 * (module.inputs.input + "\n") + "14.500000 on off\n"


RUNS = {
    "SurgicalPathScaleCLI": run_scale,
    "SimplexMesherCLI": run_surface,
    "FuchsTetrahedralizerCLI": run_mesh,
    "CommandLineTestModule": run_test_module,
}

if __name__ == "__main__":
    module, binaries, work = sys.argv[1:]
    os.environ["PATH"] = os.path.abspath(binaries) + os.pathsep + os.environ["PATH"]
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    os.chdir(work)
    RUNS[module]()
    print("nipype ran", module)
