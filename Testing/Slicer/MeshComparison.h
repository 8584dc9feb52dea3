// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether the host holds the mesh that the command-line module writes.

#include <string>
#include <vector>

class vtkMRMLModelNode;
class vtkPointSet;

namespace surgicalmesher::test
{

/// The first difference of two meshes in points, cells or arrays of points, cells and fields, compared by their bytes;
/// empty if they are the same. An array that only one has is a difference.
std::string differenceOf(vtkPointSet* a, vtkPointSet* b);

/// A .vtp or .vtu file against a model node, whose points are in RAS while the file's are in LPS.
std::string differenceOf(const std::string& file, vtkMRMLModelNode* model);

/// Whether both files can be read and have the same bytes.
bool sameBytes(const std::string& fileA, const std::string& fileB);

/// Runs one of our executables from the build tree, such as "SimplexMesherCLI", to its end. Throws std::runtime_error
/// with what it says on stderr unless it exits with 0.
void runCommandLine(const std::string& executable, const std::vector<std::string>& arguments);

/// A folder for a test's files, new and empty; the test leaves its contents there for a look after it failed.
std::string newFolder(const std::string& testName);

} // namespace surgicalmesher::test
