// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Template and patient in a 3D view each.

class vtkMRMLModelNode;
class vtkMRMLScene;
class vtkMRMLTemplateHexMesherNode;

namespace surgicalmesher
{

/// The layout of two 3D views: the template, its landmarks and what goes along in the first one; the patient, the
/// preview and the results in the second one.
class TemplateViews
{
public:
  /// Follows the parameter node: `isChosen` turns the layout on or off, and shows every node where it belongs, or in
  /// all views again. `preview` may be null.
  void update(vtkMRMLTemplateHexMesherNode* parameters, vtkMRMLModelNode* preview);

private:
  void arrange(vtkMRMLScene* scene, bool isSideBySide);

  int m_FormerLayout = -1; ///< below 0: the layout is the user's
};

} // namespace surgicalmesher
