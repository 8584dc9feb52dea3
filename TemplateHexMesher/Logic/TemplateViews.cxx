// SPDX-License-Identifier: Apache-2.0
#include "TemplateViews.h"

#include "vtkMRMLTemplateHexMesherNode.h"

#include <vtkMRMLDisplayNode.h>
#include <vtkMRMLDisplayableNode.h>
#include <vtkMRMLLayoutNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLViewNode.h>

#include <string>
#include <vector>

namespace surgicalmesher
{
namespace
{

using Node = vtkMRMLTemplateHexMesherNode;

vtkMRMLLayoutNode* layoutOf(vtkMRMLScene* scene)
{
  return vtkMRMLLayoutNode::SafeDownCast(scene->GetFirstNodeByClass("vtkMRMLLayoutNode"));
}

/// Returns the id of the 3D view with this layout name, as a list; empty, which means all views, if there is none.
std::vector<std::string> viewNamed(vtkMRMLScene* scene, const char* name)
{
  vtkMRMLNode* view = scene->GetSingletonNode(name, "vtkMRMLViewNode");
  return view ? std::vector<std::string>{ view->GetID() } : std::vector<std::string>{};
}

void showIn(const std::vector<std::string>& views, vtkMRMLNode* node)
{
  auto* displayable = vtkMRMLDisplayableNode::SafeDownCast(node);
  for (int n = 0; displayable && n < displayable->GetNumberOfDisplayNodes(); ++n)
  {
    vtkMRMLDisplayNode* display = displayable->GetNthDisplayNode(n);
    if (display && display->GetViewNodeIDs() != views) display->SetViewNodeIDs(views);
  }
}

} // namespace

void TemplateViews::arrange(vtkMRMLScene* scene, bool isSideBySide)
{
  vtkMRMLLayoutNode* layout = layoutOf(scene);
  if (!layout || isSideBySide == (m_FormerLayout >= 0)) return;
  const int former = layout->GetViewArrangement();
  layout->SetViewArrangement(isSideBySide ? int(vtkMRMLLayoutNode::SlicerLayoutDual3DView) : m_FormerLayout);
  m_FormerLayout = isSideBySide ? former : -1;
}

void TemplateViews::update(vtkMRMLTemplateHexMesherNode* parameters, vtkMRMLModelNode* preview)
{
  vtkMRMLScene* scene = parameters->GetScene();
  const bool isSideBySide = parameters->GetSideBySide();
  if (!isSideBySide && m_FormerLayout < 0) return;
  this->arrange(scene, isSideBySide);
  const std::vector<std::string> all, first = isSideBySide ? viewNamed(scene, "1") : all,
                                      second = isSideBySide ? viewNamed(scene, "2") : all;
  for (const char* role : { Node::TemplateRole(), Node::CarriedRole(), Node::TemplateLandmarksRole() })
  {
    for (vtkMRMLNode* node : parameters->GetNodes(role)) showIn(first, node);
  }
  for (const char* role : { Node::TargetRole(), Node::InnerRole(), Node::TargetLandmarksRole(), Node::FittedRole(),
                            Node::CarriedResultRole() })
  {
    for (vtkMRMLNode* node : parameters->GetNodes(role)) showIn(second, node);
  }
  if (preview) showIn(second, preview);
}

} // namespace surgicalmesher
