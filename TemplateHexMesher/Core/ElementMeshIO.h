// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Reading and writing of templates and surfaces. All functions throw InputError with the file's name, what was found
/// and what was expected. Coordinates are LPS in memory and in written files, in the file's own unit; VTK, STL and PLY
/// files that declare SPACE=RAS are converted to LPS on reading. Files are written in place; atomic replacement is left
/// to the caller.

#include "ElementMesh.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkPointSet;

namespace surgicalmesher
{

struct ElementMeshFile
{
  ElementMesh mesh;
  /// The same points and cells with all arrays that came with them. From .inp, .node and .elem: point array NodeId,
  /// cell array ElementId, and an array of 0 and 1 for each named set.
  vtkSmartPointer<vtkPointSet> data;
};

/// Reads a mesh or a surface; the extension selects the format: .vtu, .vtp, .vtk, .stl, .ply, .obj (coordinates are not
/// converted), .inp (Abaqus: C3D4, C3D6, C3D8, S3, S4 and their variants) or .node or .elem (Ansys: the other file must
/// lie beside it; hexahedra with repeated nodes are read as wedges and tetrahedra). Wedges of VTK files may have either
/// numbering if most have the same. Besides unreadable files, cells of other shapes, ids out of range, coordinates that
/// are not finite, and files without elements are refused.
ElementMeshFile readElementMesh(const std::string& file);

/// Does the same for `data` (LPS), which is kept and gets a field SPACE. `name` stands for the file in messages.
ElementMeshFile elementMeshOf(const vtkSmartPointer<vtkPointSet>& data, const std::string& name);

/// Reads the outer surface of a mesh, or a surface, as triangles without duplicate points.
TriangleSurface readSurfaceOf(const std::string& file);

/// Throws InputError if more than a tenth of the elements of one volume shape are inside out. Single inverted elements
/// are accepted, as the fit can repair them.
void requireRightSideOut(const ElementMesh& mesh, const std::string& file);

/// Writes `content` with other coordinates (a column per point) and everything else unchanged: to .vtu (a mesh or a
/// surface) or .vtp (a surface only). A template from .inp or .node can also be written to its own format; the file is
/// then a copy of `templateFile` except for the coordinates.
void writeElementMesh(const ElementMeshFile& content, const Points& points, const std::string& templateFile,
                      const std::string& file);

/// Throws UsageError if writeElementMesh() cannot write `file` from such a template.
void requireWritable(const ElementMeshFile& content, const std::string& templateFile, const std::string& file);

} // namespace surgicalmesher
