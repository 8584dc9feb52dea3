// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Templates and surfaces in files. Everything here throws InputError with the file's name, what was found and what was
/// expected. Coordinates are LPS in memory and in the files written, in the file's own unit; VTK, STL and PLY files
/// that say SPACE=RAS are turned to LPS while reading. Writers write the file as named: atomic replacement is the
/// caller's.

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

/// Reads, by the extension, .vtu, .vtp, .vtk, .stl, .ply, .obj (points stay as they stand), .inp (Abaqus: C3D4, C3D6,
/// C3D8, S3, S4 and their variants) or .node or .elem (Ansys: the other one lies beside it; hexahedra with repeated
/// nodes are wedges and tetrahedra). Wedges of VTK files may be numbered either way round, if most are alike. Refused
/// besides what can't be read: cells of other shapes, ids out of range, coordinates that are no finite numbers, no
/// element.
ElementMeshFile readElementMesh(const std::string& file);

/// The same of `data` (LPS), which is kept and gets a field SPACE; `name` stands for the file in messages.
ElementMeshFile elementMeshOf(const vtkSmartPointer<vtkPointSet>& data, const std::string& name);

/// The outer surface of a mesh, or the surface itself, as triangles, without duplicate points.
TriangleSurface readSurfaceOf(const std::string& file);

/// Throws InputError if more than a tenth of the volume elements are inside out. Single ones a fit can mend.
void requireRightSideOut(const ElementMesh& mesh, const std::string& file);

/// Writes `content` with other coordinates, a column per point, everything else as it was: to .vtu (a mesh or a
/// surface) or .vtp (a surface alone). A template from .inp or .node may also go to a file of its own kind, which is
/// then a copy of `templateFile` but for the coordinates.
void writeElementMesh(const ElementMeshFile& content, const Points& points, const std::string& templateFile,
                      const std::string& file);

/// Throws UsageError unless writeElementMesh knows how to write `file` from such a template.
void requireWritable(const ElementMeshFile& content, const std::string& templateFile, const std::string& file);

} // namespace surgicalmesher
