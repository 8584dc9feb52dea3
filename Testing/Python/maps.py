"""Real label maps for tests: boxes cut out of an atlas, and an NRRD writer by the format's own definition."""
import nibabel
import numpy as np

ATLAS = "/usr/share/mricron/templates/jhu189.nii.gz"
LPS_FROM_RAS = np.diag([-1.0, -1.0, 1.0, 1.0])


def cut_out(box):
    """Labels of a box (three slices of voxels) of the atlas, and their affine to LPS mm."""
    atlas = nibabel.load(ATLAS)
    labels = np.rint(np.asanyarray(atlas.dataobj)[box]).astype(np.uint16)
    shift = np.eye(4)
    shift[:3, 3] = [part.start for part in box]
    return labels, LPS_FROM_RAS @ atlas.affine @ shift


def write_nrrd(file, labels, affine, space="left-posterior-superior"):
    if space == "right-anterior-superior":
        affine = LPS_FROM_RAS @ affine
    vectors = ["(%s)" % ",".join("%.17g" % x for x in affine[:3, column]) for column in range(4)]
    header = ("NRRD0005\ntype: uint16\ndimension: 3\nspace: %s\nsizes: %d %d %d\nspace directions: %s %s %s\n"
              "space origin: %s\nendian: little\nencoding: raw\n\n" % (space, *labels.shape, *vectors))
    with open(file, "wb") as out:
        out.write(header.encode() + labels.tobytes(order="F"))
