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
constexpr std::array<const char*, Node::ExportElements_Last> elements{ "fourNodes", "tenNodes", "tenNodesCurved" };
constexpr std::array<const char*, Node::ExportUnits_Last> units{ "mm", "si" };

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
           { "nonlinearDistanceAtTarget", &this->NonlinearDistanceAtTarget },
           { "nullDisplacementRadius", &this->NullDisplacementRadius },
           { "nullDisplacementPathDistance", &this->NullDisplacementPathDistance },
           { "nullDisplacementPathDistanceAtTarget", &this->NullDisplacementPathDistanceAtTarget },
           { "conditioning", &this->Conditioning },
           { "featureAngle", &this->FeatureAngle },
           { "threads", &this->Threads },
           { "exportElements", choice(&this->ExportElements, elements) },
           { "exportUnits", choice(&this->ExportUnits, units) },
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

void vtkMRMLFuchsTetrahedralizerNode::SetExportElements(int elements)
{
  if (elements < 0 || elements >= ExportElements_Last || elements == this->ExportElements) return;
  this->ExportElements = elements;
  this->Modified();
}

void vtkMRMLFuchsTetrahedralizerNode::SetExportUnits(int units)
{
  if (units < 0 || units >= ExportUnits_Last || units == this->ExportUnits) return;
  this->ExportUnits = units;
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
