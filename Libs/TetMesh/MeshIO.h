// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Surface complexes and labelled tetrahedra as VTK files.
///
/// Coordinates are LPS mm in memory and in the files written (field data SPACE = LPS; in legacy files also the title).
/// Files that say SPACE=RAS are converted to LPS while reading; files that say nothing are taken as LPS. The same
/// content gives the same bytes. Everything here throws InputError: readers with the file's name, what was found and
/// what was expected; writers if the file cannot be opened or not be written completely. Writers write directly to the
/// given name: atomic replacement is up to the caller (CommandLine).

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

/// A surface complex and the data that its file stores with it.
struct SurfaceFile
{
  SurfaceComplex surface;               ///< without labels if the file has no BoundaryLabels
  std::vector<double> targetEdgeLength; ///< per point, mm; empty: the file has none
  std::vector<double> boundaryDistance; ///< per point, mm, signed; empty: the file has none
  TissueTable tissues;                  ///< names and colours
};

/// Reads .vtp, .vtk, .stl, .ply or .obj. Polygons other than triangles are triangulated, points without a triangle are
/// dropped. Refused: missing file, another format, damaged content, no triangles, point ids out of range, non-finite
/// coordinates, BoundaryLabels or point arrays of the wrong size or with values out of range, a triangle with the same
/// label on both sides or with a point used twice.
SurfaceFile readSurface(const std::string& file);

/// Writes a .vtp: BoundaryLabels (if any), TargetEdgeLength and BoundaryDistance (if not empty), SPACE, TissueIds,
/// TissueNames, TissueColors (RGB in 0..1) and, where not all are meshed alike, TissueRoles ("mesh", "shell",
/// "null displacement") of the tissues that occur.
void writeSurface(const SurfaceFile& content, const std::string& file);

/// Polygons of one tissue each, such as a simplex mesh, and the data that their file stores with them.
struct PolygonFile
{
  std::vector<Vec3> points;
  std::vector<std::vector<std::int32_t>> polygons; ///< point ids
  std::vector<Label> labels;                       ///< per polygon
  TissueTable tissues;                             ///< names and colours
};

/// Writes a .vtp: cell array TissueLabel, and field data as writeSurface does.
void writePolygons(const PolygonFile& content, const std::string& file);

/// A polyline and the data that its file stores with it.
struct Polyline
{
  std::vector<Vec3> points;
  std::vector<double> radii; ///< per point, mm; empty: the file has none
};

/// Reads the lines of a .vtp or .vtk, radii from its point array Radius. Refused: missing file, another format, damaged
/// content, no lines, non-finite coordinates, radii that are not over 0.
std::vector<Polyline> readPolylines(const std::string& file);

/// Labelled tetrahedra and the data that their file stores with them. Empty vectors: the file has no such data.
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
  /// Dihedral angle, degrees, to which the surface stage has improved the mesh, except in single places; 0: unknown.
  double targetAngle = 0;
};

/// Reads tetrahedra with a cell array TissueLabel from a .vtu or .vtk, ambient complexes (label 0 outside) included.
/// Refused, beyond what readSurface refuses: cells other than tetrahedra, no TissueLabel, tetrahedra that are inverted
/// or flat, points that no tetrahedron uses.
MeshFile readMesh(const std::string& file);

/// Starts reading a mesh in the background. The returned function waits for the result; it is to be called once. Both
/// throw like readMesh().
std::function<MeshFile()> beginReadingMesh(const std::string& file);

/// Converts a grid in memory, with the checks of readMesh(). `ras`: whether the grid's coordinates are RAS, whatever
/// its field data say; `name` stands for the file in messages.
MeshFile meshOfGrid(vtkUnstructuredGrid* grid, bool ras, const std::string& name);

/// Reads names, colours and roles from field data. Missing entries and arrays of another type are skipped without an
/// error, as nothing depends on them.
TissueTable tissuesOf(vtkFieldData* data);

/// Adds SPACE = LPS, and the names, colours and roles of the tissues in `present`, to field data.
void addTissues(vtkFieldData* data, const std::set<Label>& present, const TissueTable& tissues);

/// Whether files have the texts of field data (SPACE, TissueNames, TissueRoles), at which readers other than VTK's own
/// tend to fail. Legacy files without them are text, to eleven digits, and have no field data at all: Gmsh 4.8 rejects
/// field data before the points, and SOFA does not swap the bytes of cell data.
enum class FieldTexts
{
  Written,
  LeftOut
};

/// Writes a .vtp (compressed).
void writePolyData(vtkPolyData* data, const std::string& file);

/// Writes a .vtu (compressed) or a legacy .vtk (binary, unless texts are left out), by the file's extension.
void writeMesh(const MeshFile& content, const std::string& file, FieldTexts texts = FieldTexts::Written);

/// Writes a grid with its arrays likewise; texts that are left out are removed from the grid's field data.
void writeGrid(vtkUnstructuredGrid* grid, const std::string& file, FieldTexts texts);

/// Writes the curves of a mesh as the lines of a .vtp: point arrays VolumePointId, the point's id in the mesh, and
/// Radius (mm; 0: not given); cell array CurveId from 0; field data CurveNames and SPACE. Curves that meet share
/// points.
void writeCurves(const MeshFile& content, const std::string& file);

} // namespace surgicalmesher
