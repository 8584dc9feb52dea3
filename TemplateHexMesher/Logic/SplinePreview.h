// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The template's outer surface where the spline of the landmarks alone takes it.

#include "ElementMesh.h"

#include <vtkType.h>
#include <vtkWeakPointer.h>

class vtkMRMLModelNode;
class vtkMRMLTemplateHexMesherNode;
class vtkPointSet;

namespace surgicalmesher
{

class SplinePreview
{
public:
  /// Shows the surface as the pairs placed so far have it, or hides it where it is not asked for, or they don't
  /// suffice. The model is neither listed nor saved.
  void update(vtkMRMLTemplateHexMesherNode* parameters);
  /// Null before it was shown.
  vtkMRMLModelNode* model() const;

private:
  const TriangleSurface& surfaceOf(vtkMRMLModelNode* model);
  bool fill(vtkMRMLTemplateHexMesherNode* parameters);

  vtkWeakPointer<vtkMRMLModelNode> m_Model;
  TriangleSurface m_Surface; ///< of the template, LPS
  vtkPointSet* m_Mesh = nullptr;
  vtkMTimeType m_Time = 0;
};

} // namespace surgicalmesher
