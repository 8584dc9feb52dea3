// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Preview of the template's outer surface, deformed by the spline of the landmarks alone.

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
  /// Updates the surface from the pairs placed so far. Hides it if the preview is off or the pairs are not sufficient.
  /// The model is neither listed nor saved.
  void update(vtkMRMLTemplateHexMesherNode* parameters);
  /// Null until the preview is first shown.
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
