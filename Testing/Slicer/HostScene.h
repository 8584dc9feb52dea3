// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Small inputs for the modules, made as nodes of a scene, and a check of what a run leaves behind.
///
/// World is the host's here: RAS, mm.

#include <array>
#include <functional>
#include <set>
#include <string>
#include <vector>

class vtkMRMLLabelMapVolumeNode;
class vtkMRMLMarkupsNode;
class vtkMRMLScene;
class vtkMRMLScalarVolumeNode;
class vtkMRMLSegmentationNode;
class vtkMRMLStorableNode;
class vtkMRMLTransformableNode;
class vtkMRMLTransformNode;
class vtkMRMLVolumeNode;

namespace surgicalmesher::test
{

using Point = std::array<double, 3>;

/// A cube of voxels centred at the world's origin, labelled by world position.
vtkMRMLLabelMapVolumeNode* addLabelMap(vtkMRMLScene* scene, const char* name, int voxelsPerSide, double spacing,
                                       const std::function<int(const Point&)>& labelAt);

/// A ball of label 1 (radius 6 mm) within a shell of label 2 (radius 10 mm), in voxels of 1 mm: meshed in about a
/// second at lengths of 3 mm. Named and coloured by a colour table node: 1 tumour, red; 2 brain, grey.
vtkMRMLLabelMapVolumeNode* addNestedBalls(vtkMRMLScene* scene, const char* name = "NestedBalls");

/// The label map's tissues as segments, with its names, colours and geometry. The label map stays.
vtkMRMLSegmentationNode* addSegmentation(vtkMRMLScene* scene, vtkMRMLLabelMapVolumeNode* labelMap,
                                         const char* name = "Segmentation");

/// A segmentation without a segment.
vtkMRMLSegmentationNode* addEmptySegmentation(vtkMRMLScene* scene, const char* name = "Empty");

/// A label map of a file, in the way that the host's own dialogue loads it. Null if it can't be read.
vtkMRMLLabelMapVolumeNode* loadLabelMap(vtkMRMLScene* scene, const std::string& fileName);

/// An image of a file, in the same way.
vtkMRMLScalarVolumeNode* loadVolume(vtkMRMLScene* scene, const std::string& fileName);

/// Writes the host's own file of a node, in the format that its ending says. The file's name; empty if that failed.
std::string savedByHost(vtkMRMLStorableNode* node, const std::string& fileName);

/// The JHU atlas of 189 brain tissues, and a T1 image in its space, where Debian's mricron-data has put them; empty if
/// it is not installed.
std::string jhuAtlasFile();
std::string brainImageFile();

/// The T1 image of the same head with all that is around the brain, from the same package.
std::string headImageFile();

/// The atlas in its place. Of the two places that its file gives, the host takes the wrong one.
vtkMRMLLabelMapVolumeNode* loadJhuAtlas(vtkMRMLScene* scene);

/// As the label map of all slice views, or as their background; fits them to it.
void showInSliceViews(vtkMRMLVolumeNode* volume);

/// A markups node of a class such as "vtkMRMLMarkupsFiducialNode" or "vtkMRMLMarkupsCurveNode".
vtkMRMLMarkupsNode* addMarkups(vtkMRMLScene* scene, const char* className, const std::vector<Point>& points);

/// A rotation of 30 degrees about the superior axis, then a shift by (5, -3, 2) mm.
vtkMRMLTransformNode* addTransform(vtkMRMLScene* scene);

/// What the host would not forgive us to forget: nodes there are now and were not before. Hidden ones count.
class LeftoverCheck
{
public:
  explicit LeftoverCheck(vtkMRMLScene* scene);

  /// "class name (id)" of every new node that is not of one of these classes, one per line; empty if there is none.
  std::string leftovers(const std::set<std::string>& expectedClasses = {}) const;

private:
  vtkMRMLScene* m_Scene;
  std::set<std::string> m_Before;
};

/// Files in the host's folder for temporary files, to see that a run takes its own along.
std::set<std::string> temporaryFiles();

} // namespace surgicalmesher::test
