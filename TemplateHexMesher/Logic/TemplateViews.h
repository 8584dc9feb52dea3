// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Layout with template and patient in separate 3D views.

class vtkMRMLModelNode;
class vtkMRMLScene;
class vtkMRMLTemplateHexMesherNode;

namespace surgicalmesher
{

/// Arranges two 3D views: the template, its landmarks and the carried models in the first; the patient, the preview and
/// the results in the second.
class TemplateViews
{
public:
  /// Applies the parameter node's SideBySide: switches the layout, and shows every node in its view, or in all views
  /// again. `preview` may be null.
  void update(vtkMRMLTemplateHexMesherNode* parameters, vtkMRMLModelNode* preview);

private:
  void arrange(vtkMRMLScene* scene, bool isSideBySide);

  int m_FormerLayout = -1; ///< layout to restore; below 0: the user's layout is active
};

} // namespace surgicalmesher
