// SPDX-License-Identifier: Apache-2.0
#include "RunAdvice.h"

#include "PanelObstacle.h"
#include "qSlicerFuchsTetrahedralizerModuleWidget.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"

#include <vtkMRMLModelNode.h>
#include <vtkMRMLTransformableNode.h>
#include <vtkWeakPointer.h>

#include <vector>

using Logic = vtkSlicerFuchsTetrahedralizerLogic;
using Node = vtkMRMLFuchsTetrahedralizerNode;
using Panel = qSlicerFuchsTetrahedralizerModuleWidget;
using Problem = Logic::Problem;

namespace
{

std::function<void(Node*)> leaveOut(const char* role, vtkMRMLNode* node)
{
  vtkWeakPointer<vtkMRMLNode> unwanted = node;
  return [role, unwanted](Node* parameters)
  {
    std::vector<vtkMRMLNode*> kept;
    for (vtkMRMLNode* each : parameters->GetNodes(role))
      if (each != unwanted) kept.push_back(each);
    parameters->SetNodes(role, kept);
  };
}

/// Clears the first output role that has this node.
void forgetOutput(Node* parameters, vtkMRMLNode* node)
{
  for (const char* role : { Node::ShellsRole(), Node::ChildMeshRole(), Node::ParentMeshRole(), Node::MeshRole() })
  {
    if (!node || parameters->GetNodeReference(role) != node) continue;
    parameters->SetNode(role, nullptr);
    return;
  }
}

Advice adviceOnInput(const Logic::Check& check, Logic* logic)
{
  const QString name = check.node ? QString::fromUtf8(check.node->GetName()) : QString();
  vtkWeakPointer<vtkMRMLNode> node = check.node;
  switch (check.problem)
  {
  case Problem::NoSurface:
  {
    const std::vector<vtkMRMLModelNode*> surfaces = logic->LabelledSurfaces();
    if (surfaces.empty())
      return { Panel::tr("There is no surface: make one with Simplex Mesher, or load closed models."),
               Panel::tr("Simplex Mesher"), [](Node*) { surgicalmesher::openModule("SimplexMesher"); } };
    vtkWeakPointer<vtkMRMLNode> latest = surfaces.back();
    return { Panel::tr("Choose a surface."), Panel::tr("Take %1").arg(QString::fromUtf8(latest->GetName())),
             [latest](Node* p) { p->SetNode(Node::SurfaceRole(), latest); } };
  }
  case Problem::NotASurface:
    return { Panel::tr("%1 has no triangles.").arg(name), Panel::tr("Leave it out"),
             leaveOut(Node::SurfaceRole(), node) };
  case Problem::LabelledAmongOthers:
    return { Panel::tr("%1 is a surface of several tissues, which can't be meshed along with other models.").arg(name),
             Panel::tr("Take it alone"), [node](Node* p) { p->SetNode(Node::SurfaceRole(), node); } };
  case Problem::NoTargetLengths:
    return { Panel::tr("The surface has no edge lengths of its own."), Panel::tr("Take one length"),
             [](Node* p) { p->SetEdgeLengthSource(Node::Uniform); } };
  case Problem::NoScale:
    return { Panel::tr("Choose a scale volume, as Surgical Path Scale makes it."), Panel::tr("Take one length"),
             [](Node* p) { p->SetEdgeLengthSource(Node::Uniform); } };
  case Problem::ScaleWarped:
    return { Panel::tr("%1 is under a transform that isn't linear.").arg(name), Panel::tr("Harden the transform"),
             [node](Node*)
             {
               if (auto* scale = vtkMRMLTransformableNode::SafeDownCast(node)) scale->HardenTransform();
             } };
  case Problem::NoEdgeLength:
    return { Panel::tr("The edge length has to be over 0 mm."), Panel::tr("Take 2 mm"),
             [](Node* p) { p->SetEdgeLength(2); } };
  case Problem::AmbientChanged:
    return { Panel::tr("%1 was edited after Simplex Mesher had made it with its tetrahedra.").arg(name),
             Panel::tr("Begin from the surface alone"), [](Node* p) { p->UseAmbientOff(); } };
  default: return {};
  }
}

Advice adviceOnClasses(const Logic::Check& check)
{
  switch (check.problem)
  {
  case Problem::NotAPath:
    return { Panel::tr("%1 has fewer than two points, so it is no path.").arg(QString::fromUtf8(check.node->GetName())),
             Panel::tr("Leave it out"), leaveOut(Node::PathRole(), check.node) };
  case Problem::NoTargets:
    return { Panel::tr("Choose targets with points, as tissue is to be still beyond a distance from them."),
             Panel::tr("No distance from targets"), [](Node* p) { p->SetNullDisplacementRadius(0); } };
  case Problem::NoPaths:
    return { Panel::tr("Choose paths, as tissue is to be still beyond a distance from them."),
             Panel::tr("No distance from paths"), [](Node* p) { p->SetNullDisplacementPathDistance(0); } };
  case Problem::NoPlaces:
    return { Panel::tr("Choose targets or paths, as tissue is to be nonlinear up to a distance from them."),
             Panel::tr("No such distance"), [](Node* p) { p->SetNonlinearDistance(0); } };
  case Problem::NoDistance:
    return { Panel::tr("Targets and paths need a distance that goes with them."), Panel::tr("Nonlinear up to 25 mm"),
             [](Node* p) { p->SetNonlinearDistance(25); } };
  case Problem::NoEntryDistance:
    return { Panel::tr("There is a distance at the target end of paths, but none at their entry."),
             Panel::tr("The same at the entry"),
             [](Node* p) { p->SetNullDisplacementPathDistance(p->GetNullDisplacementPathDistanceAtTarget()); } };
  case Problem::NoNonlinearEntry:
    return { Panel::tr("There is a nonlinear distance at the target end of paths, but no path, or none at its entry."),
             Panel::tr("The same all along"), [](Node* p) { p->SetNonlinearDistanceAtTarget(0); } };
  default: return {};
  }
}

Advice adviceOnElements(const Logic::Check& check)
{
  const QString name = check.node ? QString::fromUtf8(check.node->GetName()) : QString();
  const QString text = QString::fromStdString(check.text);
  vtkWeakPointer<vtkMRMLNode> node = check.node;
  switch (check.problem)
  {
  case Problem::OutputIsInput:
    return { Panel::tr("%1 is chosen twice; an output has to be a model of its own.").arg(name),
             Panel::tr("Don't write it"), [node](Node* p) { forgetOutput(p, node); } };
  case Problem::UnknownShell:
    return { Panel::tr("\"%1\" are not tissues of the surface.").arg(text), Panel::tr("No shells"),
             [](Node* p) { p->SetShellTissues(""); } };
  case Problem::ShellsUnused:
    return { Panel::tr("Name the tissues that become shells, as %1 is to take them.").arg(name), Panel::tr("No shells"),
             [](Node* p) { p->SetNode(Node::ShellsRole(), nullptr); } };
  case Problem::BadMaterials:
    return { Panel::tr("The materials can't be used: %1").arg(text), Panel::tr("Without materials"),
             [](Node* p) { p->SetMaterialsFile(""); } };
  default: return {};
  }
}

} // namespace

Advice adviceOn(const Logic::Check& check, Logic* logic)
{
  switch (check.problem)
  {
  case Problem::NoModule:
    return { Panel::tr("The command-line module FuchsTetrahedralizerCLI is not installed."), {}, {} };
  case Problem::NotAPath:
  case Problem::NoTargets:
  case Problem::NoPaths:
  case Problem::NoPlaces:
  case Problem::NoDistance:
  case Problem::NoEntryDistance:
  case Problem::NoNonlinearEntry: return adviceOnClasses(check);
  case Problem::OutputIsInput:
  case Problem::UnknownShell:
  case Problem::ShellsUnused:
  case Problem::BadMaterials: return adviceOnElements(check);
  default: return adviceOnInput(check, logic);
  }
}
