// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Surface complexes and labelled tetrahedra as VTK files.
///
/// Coordinates are LPS mm in memory and in the files written (field data SPACE = LPS; in legacy files also the title).
/// Files that say SPACE=RAS are turned to LPS while reading; files that say nothing are taken as LPS. The same content
/// gives the same bytes. Everything here throws InputError: readers with the file's name, what was found and what was
/// expected; writers when the file can't be opened or not be written to its end. Writers write the file as named:
/// atomic replacement is the caller's (CommandLine).

#include "CurveChain.h"
#include "TetMesh.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

class vtkFieldData;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace surgicalmesher
{

/// A surface complex and what travels with it in its file.
struct SurfaceFile
{
  SurfaceComplex surface;               ///< labels is empty in surfaces from elsewhere, without BoundaryLabels
  std::vector<double> targetEdgeLength; ///< per point, mm; empty: the file has none
  std::vector<double> boundaryDistance; ///< per point, mm, signed; empty: the file has none
  TissueTable tissues;                  ///< names and colours
};

/// Reads .vtp, .vtk, .stl, .ply or .obj; other polygons than triangles are triangulated, points without a triangle
/// dropped.
/// Refused: missing file, another format, damaged content, no triangles, point ids out of range, non-finite
/// coordinates, BoundaryLabels or point arrays of the wrong size or with values out of range, a triangle with the same
/// label on both sides or with a point used twice.
SurfaceFile readSurface(const std::string& file);

/// Writes a .vtp: BoundaryLabels (if any), TargetEdgeLength and BoundaryDistance (if not empty), SPACE, TissueIds,
/// TissueNames, TissueColors (RGB in 0..1) and, where not all are meshed alike, TissueRoles ("mesh", "shell",
/// "null displacement") of the tissues that occur.
void writeSurface(const SurfaceFile& content, const std::string& file);

/// Polygons of one tissue each, a simplex mesh for one, and what travels with them in their file.
struct PolygonFile
{
  std::vector<Vec3> points;
  std::vector<std::vector<std::int32_t>> polygons; ///< point ids
  std::vector<Label> labels;                       ///< per polygon
  TissueTable tissues;                             ///< names and colours
};

/// Writes a .vtp: cell array TissueLabel, and field data as writeSurface does.
void writePolygons(const PolygonFile& content, const std::string& file);

/// A polyline and what travels with it in its file.
struct Polyline
{
  std::vector<Vec3> points;
  std::vector<double> radii; ///< per point, mm; empty: the file has none
};

/// Reads the lines of a .vtp or .vtk, radii from its point array Radius. Refused: missing file, another format, damaged
/// content, no lines, non-finite coordinates, radii that are not over 0.
std::vector<Polyline> readPolylines(const std::string& file);

/// Labelled tetrahedra and what travels with them in their file. Empty vectors: the file has none.
struct MeshFile
{
  TetMesh mesh;
  std::vector<std::int32_t> subMesh;          ///< per tetrahedron: 0 parent, 1..n child
  std::vector<std::int32_t> constitutive;     ///< per tetrahedron: 0 linear, 1 nonlinear, 2 null displacement
  std::vector<std::int32_t> subMeshInterface; ///< per point: 1 where two sub-meshes meet, else 0
  std::vector<double> targetEdgeLength;       ///< per point, mm
  std::vector<std::int32_t> volumePointId;    ///< per point of a part: its id in the whole mesh
  std::vector<std::int32_t> interfaceId; ///< per point of a part: its number on the child/parent interface, -1 none
  TissueTable tissues;                   ///< names and colours
  std::vector<CurveChain> curves;        ///< along edges; they have a file of their own
  /// Degrees, dihedral: what the surface stage has improved the mesh to, but for single places; 0: nobody says.
  double targetAngle = 0;
};

/// Reads tetrahedra with a cell array TissueLabel from a .vtu or .vtk, ambient complexes (label 0 outside) included.
/// Refused, beyond what readSurface refuses: cells other than tetrahedra, no TissueLabel, tetrahedra that are inverted
/// or flat, points that no tetrahedron uses.
MeshFile readMesh(const std::string& file);

/// Begins to read it while this process goes on; what is returned ends it, to be called once. Both throw as readMesh()
/// does.
std::function<MeshFile()> beginReadingMesh(const std::string& file);

/// The same from memory. `ras`: the grid's coordinates are RAS, which its field data need not know; `name` stands for
/// the file in messages.
MeshFile meshOfGrid(vtkUnstructuredGrid* grid, bool ras, const std::string& name);

/// Names, colours and roles in field data; tables that are incomplete or of other kinds are left out, as nothing
/// depends on them.
TissueTable tissuesOf(vtkFieldData* data);

/// SPACE = LPS, and names, colours and roles of the tissues that occur, into field data.
void addTissues(vtkFieldData* data, const std::set<Label>& present, const TissueTable& tissues);

/// Texts in field data, SPACE and TissueNames: readers other than VTK's own tend to stumble over them. Legacy files
/// without them are text, to eleven digits, and have no field data at all: Gmsh 4.8 refuses it before the points, and
/// SOFA does not swap the bytes of cell data.
enum class FieldTexts
{
  Written,
  LeftOut
};

/// Writes a .vtp (compressed).
void writePolyData(vtkPolyData* data, const std::string& file);

/// Writes a .vtu (compressed) or a legacy .vtk (binary, unless texts are left out), by the file's extension.
void writeMesh(const MeshFile& content, const std::string& file, FieldTexts texts = FieldTexts::Written);

/// Writes a grid with its arrays likewise.
void writeGrid(vtkUnstructuredGrid* grid, const std::string& file, FieldTexts texts);

/// Writes the curves of a mesh as the lines of a .vtp: point arrays VolumePointId, the point's id in the mesh, and Radius
/// (mm; 0: not given); cell array CurveId from 0; field data CurveNames and SPACE. Curves that meet share points.
void writeCurves(const MeshFile& content, const std::string& file);

} // namespace surgicalmesher
