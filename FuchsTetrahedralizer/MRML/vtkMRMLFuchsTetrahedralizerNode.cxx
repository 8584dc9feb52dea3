// SPDX-License-Identifier: Apache-2.0
#include "vtkMRMLFuchsTetrahedralizerNode.h"

#include <vtkObjectFactory.h>

#include <array>

namespace
{

using Node = vtkMRMLFuchsTetrahedralizerNode;

constexpr std::array<const char*, Node::EdgeLengthSource_Last> edgeLengthSources{ "surface", "scale", "uniform" };
constexpr std::array<const char*, Node::ColorBy_Last> colors{ "tissue", "subMesh", "constitutiveClass",
                                                              "minimumDihedralAngle", "radiusRatio" };
constexpr std::array<const char*, Node::ClipPlane_Last> planes{ "none", "axial", "sagittal", "coronal" };

} // namespace

vtkMRMLNodeNewMacro(vtkMRMLFuchsTetrahedralizerNode);

vtkMRMLFuchsTetrahedralizerNode::vtkMRMLFuchsTetrahedralizerNode()
{
  this->AddRoles({ SurfaceRole(), ScaleRole(), TargetRole(), PathRole(), MeshRole(), ParentMeshRole(), ChildMeshRole(),
                   ShellsRole() },
                 "NodeRef");
}

std::vector<vtkMRMLSurgicalMesherParameterNode::Value> vtkMRMLFuchsTetrahedralizerNode::GetValues()
{
  const auto choice = [](int* index, const auto& names) { return Choice{ index, { names.begin(), names.end() } }; };
  return { { "edgeLengthSource", choice(&this->EdgeLengthSource, edgeLengthSources) },
           { "edgeLength", &this->EdgeLength },
           { "useAmbient", &this->UseAmbient },
           { "shellTissues", &this->ShellTissues },
           { "shellThickness", &this->ShellThickness },
           { "materialsFile", &this->MaterialsFile },
           { "nonlinearDistance", &this->NonlinearDistance },
           { "nullDisplacementRadius", &this->NullDisplacementRadius },
           { "nullDisplacementPathDistance", &this->NullDisplacementPathDistance },
           { "nullDisplacementPathDistanceAtTarget", &this->NullDisplacementPathDistanceAtTarget },
           { "conditioning", &this->Conditioning },
           { "threads", &this->Threads },
           { "colorBy", choice(&this->ColorBy, colors) },
           { "clipPlane", choice(&this->ClipPlane, planes) },
           { "clipFlipped", &this->ClipFlipped },
           { "showEdges", &this->ShowEdges } };
}

void vtkMRMLFuchsTetrahedralizerNode::SetEdgeLengthSource(int source)
{
  if (source < 0 || source >= EdgeLengthSource_Last || source == this->EdgeLengthSource) return;
  this->EdgeLengthSource = source;
  this->Modified();
}

void vtkMRMLFuchsTetrahedralizerNode::SetColorBy(int colorBy)
{
  if (colorBy < 0 || colorBy >= ColorBy_Last || colorBy == this->ColorBy) return;
  this->ColorBy = colorBy;
  this->Modified();
}

void vtkMRMLFuchsTetrahedralizerNode::SetClipPlane(int plane)
{
  if (plane < 0 || plane >= ClipPlane_Last || plane == this->ClipPlane) return;
  this->ClipPlane = plane;
  this->Modified();
}
