// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Safe reading of VTK's file formats. VTK's readers trust what a damaged file says, and crash, exit or never end; so
/// they run in a process of their own, of limited time.

#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// The content of a file.
struct VTKFile
{
  vtkSmartPointer<vtkPointSet> data; ///< vtkPolyData or vtkUnstructuredGrid, with valid point ids
  bool ras = false;                  ///< the file says, in its title or its field data, SPACE=RAS
};

/// Reads a file with all its arrays. `extensions`: those allowed, among .vtp, .vtu, .vtk (polygonal data or an
/// unstructured grid), .stl, .ply and .obj. Throws InputError with the file's name if the file is missing, has another
/// extension, is damaged, has a header that claims more points or cells than it has room for, has cells with invalid
/// point ids, or takes more processor time than ten seconds plus half a second per megabyte (by the clock, ten times as
/// long).
VTKFile readVTKFile(const std::string& file, const std::vector<std::string>& extensions);

/// Starts reading a file in the background. The returned function waits for the result; it is to be called once. Both
/// throw like readVTKFile().
std::function<VTKFile()> beginReadingVTKFile(const std::string& file, const std::vector<std::string>& extensions);

/// Throws InputError, with `name`, unless the cells' offsets ascend and their point ids are valid: otherwise VTK's
/// filters would access memory out of bounds.
void requireValidCells(vtkPointSet* data, const std::string& name);

} // namespace surgicalmesher
