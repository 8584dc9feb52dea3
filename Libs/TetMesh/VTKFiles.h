// SPDX-License-Identifier: Apache-2.0
#pragma once
/// VTK's files, read safely: VTK's readers take what a damaged file says at its word, and crash, exit or go on without
/// end. They run in a process of their own, of limited time.

#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// What a file holds.
struct VTKFile
{
  vtkSmartPointer<vtkPointSet> data; ///< vtkPolyData or vtkUnstructuredGrid; every id is that of a point
  bool ras = false;                  ///< the file says, in its title or its field data, SPACE=RAS
};

/// Reads a file of one of `extensions`, which are of .vtp, .vtu, .vtk (polygonal data or an unstructured grid), .stl,
/// .ply and .obj, with all its arrays. Throws InputError with the file's name: missing, of another extension, damaged, more points
/// or cells in its header than it has room for, cells of points that are not there, or more than ten seconds and half a
/// second for each megabyte, of processor time; by the clock ten times as long.
VTKFile readVTKFile(const std::string& file, const std::vector<std::string>& extensions);

/// Begins to read a file while this process goes on; what is returned ends it, to be called once. Both throw as
/// readVTKFile() does.
std::function<VTKFile()> beginReadingVTKFile(const std::string& file, const std::vector<std::string>& extensions);

/// Throws InputError, with `name`, unless the cells' offsets ascend and their ids are those of points: VTK's filters
/// would leave their memory.
void requireValidCells(vtkPointSet* data, const std::string& name);

} // namespace surgicalmesher
