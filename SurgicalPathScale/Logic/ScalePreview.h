// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Overlays of the scale and the null displacement of a parameter node in the slice views, coarse enough to follow a
/// slider, and the expected size of the mesh.

#include "MeshSizeEstimate.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>
#include <vtkWeakPointer.h>

#include <map>
#include <memory>
#include <string>

class vtkMRMLLabelMapVolumeNode;
class vtkMRMLNode;
class vtkMRMLScalarVolumeNode;
class vtkMRMLScene;
class vtkMRMLSliceCompositeNode;
class vtkMRMLSurgicalPathScaleNode;
class vtkMRMLVolumeNode;

namespace surgicalmesher
{

class ScalePreview
{
public:
  ~ScalePreview();

  /// Computes the overlays and shows them. The volumes are hidden nodes that are not saved with the scene. Throws an
  /// Error with a message if the parameters cannot be used.
  void show(vtkMRMLSurgicalPathScaleNode* parameters);
  /// Removes the overlays and restores what the slice views showed before.
  void hide();
  bool isShown() const { return m_Scale != nullptr; }
  vtkMRMLScalarVolumeNode* scaleNode() const { return m_Scale; }
  vtkMRMLLabelMapVolumeNode* nullDisplacementNode() const { return m_NullDisplacement; }

  /// Throws as show does.
  MeshSizeEstimate estimate(vtkMRMLSurgicalPathScaleNode* parameters);

  /// Returns the tissue map of the parameter node, read again only after a change. Throws InputError.
  const TissueMap& tissueMap(vtkMRMLNode* input);
  void forgetTissueMap() { m_Map.reset(); }

private:
  struct Layers
  {
    std::string foreground;
    double foregroundOpacity;
    std::string label;
    double labelOpacity;
  };

  void showScale(vtkMRMLScene* scene, const ScaleField& scale);
  void showNullDisplacement(vtkMRMLSurgicalPathScaleNode* parameters, const TissueMap& map);
  void hideNullDisplacement();
  void putIntoSliceViews(vtkMRMLScene* scene);

  vtkWeakPointer<vtkMRMLNode> m_Input;
  vtkMTimeType m_InputTime = 0;
  std::unique_ptr<TissueMap> m_Map;
  vtkSmartPointer<vtkMRMLScalarVolumeNode> m_Scale;
  vtkSmartPointer<vtkMRMLLabelMapVolumeNode> m_NullDisplacement;
  std::map<std::string, Layers> m_Before; ///< by id of the slice view's composite node
};

/// Shows the volume as foreground of every slice view.
void showInSliceViews(vtkMRMLScalarVolumeNode* scale);

/// Sets the voxel grid of a volume node from `grid`, which is in LPS.
void setGrid(vtkMRMLVolumeNode* node, const Grid& grid);

/// Colours edge lengths from short (hot) to long (cold), with a legend.
void setScaleColors(vtkMRMLScalarVolumeNode* node, double shortest, double longest);

} // namespace surgicalmesher
