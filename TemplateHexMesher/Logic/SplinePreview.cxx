// SPDX-License-Identifier: Apache-2.0
#include "SplinePreview.h"

#include "Errors.h"
#include "LandmarkLists.h"
#include "ModelMeshes.h"
#include "SceneNodes.h"
#include "ThinPlateSpline.h"
#include "vtkMRMLTemplateHexMesherNode.h"

#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace surgicalmesher
{
namespace
{

using Node = vtkMRMLTemplateHexMesherNode;

vtkSmartPointer<vtkPolyData> inRAS(const Points& points, const std::vector<Triangle>& triangles)
{
  vtkNew<vtkPoints> places;
  for (Eigen::Index i = 0; i < points.cols(); ++i) places->InsertNextPoint(-points(0, i), -points(1, i), points(2, i));
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : triangles) cells->InsertNextCell({ a, b, c });
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(places);
  surface->SetPolys(cells);
  return surface;
}

vtkMRMLModelNode* addModel(vtkMRMLScene* scene)
{
  vtkNew<vtkMRMLModelNode> model;
  model->SetName("Template Hex Mesher preview");
  addHidden(scene, model);
  model->CreateDefaultDisplayNodes();
  vtkMRMLDisplayNode* display = model->GetDisplayNode();
  display->SetSaveWithScene(false);
  display->SetColor(0.94, 0.58, 0.33);
  display->SetOpacity(0.5);
  return model;
}

} // namespace

vtkMRMLModelNode* SplinePreview::model() const { return m_Model; }

const TriangleSurface& SplinePreview::surfaceOf(vtkMRMLModelNode* model)
{
  vtkPointSet* mesh = model->GetMesh();
  const bool isKnown = mesh == m_Mesh && mesh->GetMTime() == m_Time;
  if (isKnown && !model->GetParentTransformNode()) return m_Surface;
  const ElementMesh content = meshInWorld(model).mesh;
  m_Surface = compacted(content.points, trianglesOf(outerFaces(content.elements), content.points));
  m_Mesh = model->GetParentTransformNode() ? nullptr : mesh;
  m_Time = mesh->GetMTime();
  return m_Surface;
}

bool SplinePreview::fill(vtkMRMLTemplateHexMesherNode* parameters)
{
  vtkMRMLModelNode* source = parameters->GetModelNode(Node::TemplateRole());
  if (!parameters->GetShowPreview() || !source || !hasCells(source)) return false;
  const LandmarkPairs pairs = commonPairs(parameters->GetMarkupsNode(Node::TemplateLandmarksRole()),
                                          parameters->GetMarkupsNode(Node::TargetLandmarksRole()));
  try
  {
    requireUsable(pairs, "template", "patient");
    const TriangleSurface& surface = this->surfaceOf(source);
    const Points moved = ThinPlateSpline(pairs.source, pairs.target)(surface.points);
    if (!m_Model || !m_Model->GetScene()) m_Model = addModel(parameters->GetScene());
    m_Model->SetAndObserveMesh(inRAS(moved, surface.triangles));
  }
  catch (const Error&)
  {
    return false; // the reason is shown at the foot of the panel
  }
  return true;
}

void SplinePreview::update(vtkMRMLTemplateHexMesherNode* parameters)
{
  const bool isShown = this->fill(parameters);
  if (m_Model && m_Model->GetDisplayNode()) m_Model->GetDisplayNode()->SetVisibility(isShown);
}

} // namespace surgicalmesher
