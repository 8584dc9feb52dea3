// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the stages before leave for this module: two nested balls, once as files and once as nodes of the host's scene.

#include <string>

class vtkMRMLModelNode;
class vtkMRMLScalarVolumeNode;
class vtkMRMLScene;

namespace surgicalmesher::test
{

/// Files of HostScene's nested balls in a new folder: lengths from 1.5 mm around the origin to 4 mm, so that there is a
/// child.
struct MeshedBalls
{
  std::string folder, map, scale, surface, ambient;
};
MeshedBalls meshBalls(vtkMRMLScene* scene, const std::string& testName);

vtkMRMLModelNode* loadModel(vtkMRMLScene* scene, const std::string& file, const char* name);
vtkMRMLScalarVolumeNode* loadVolume(vtkMRMLScene* scene, const std::string& file, const char* name);

/// The surface with its ambient tetrahedra, as Simplex Mesher leaves them in the scene.
vtkMRMLModelNode* loadSurface(vtkMRMLScene* scene, const MeshedBalls& balls);

/// A ball's surface, triangulated and closed.
vtkMRMLModelNode* addClosedBall(vtkMRMLScene* scene, const char* name, double radius);

} // namespace surgicalmesher::test
