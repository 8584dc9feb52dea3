// SPDX-License-Identifier: Apache-2.0
#include "vtkMRMLFuchsTetrahedralizerNode.h"

#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

#include <vtkObjectFactory.h>

#include <array>
#include <cstring>

namespace
{

using Node = vtkMRMLFuchsTetrahedralizerNode;

constexpr std::array<const char*, Node::EdgeLengthSource_Last> edgeLengthSources{ "surface", "scale", "uniform" };
constexpr std::array<const char*, Node::ColorBy_Last> colors{ "tissue", "subMesh", "constitutiveClass",
                                                              "minimumDihedralAngle", "radiusRatio" };
constexpr std::array<const char*, Node::ClipPlane_Last> planes{ "none", "axial", "sagittal", "coronal" };

template <std::size_t N>
const char* nameAt(const std::array<const char*, N>& names, int index)
{
  return index >= 0 && index < int(N) ? names[index] : "";
}

/// -1, the macros' sign for an unknown value, if it isn't one of them.
template <std::size_t N>
int indexOf(const std::array<const char*, N>& names, const char* name)
{
  for (std::size_t i = 0; name && i < N; ++i)
  {
    if (!std::strcmp(names[i], name)) return int(i);
  }
  return -1;
}

} // namespace

vtkMRMLNodeNewMacro(vtkMRMLFuchsTetrahedralizerNode);

const char* vtkMRMLFuchsTetrahedralizerNode::SurfaceRole() { return "surface"; }
const char* vtkMRMLFuchsTetrahedralizerNode::ScaleRole() { return "scale"; }
const char* vtkMRMLFuchsTetrahedralizerNode::TargetRole() { return "target"; }
const char* vtkMRMLFuchsTetrahedralizerNode::PathRole() { return "path"; }
const char* vtkMRMLFuchsTetrahedralizerNode::MeshRole() { return "mesh"; }
const char* vtkMRMLFuchsTetrahedralizerNode::ParentMeshRole() { return "parentMesh"; }
const char* vtkMRMLFuchsTetrahedralizerNode::ChildMeshRole() { return "childMesh"; }
const char* vtkMRMLFuchsTetrahedralizerNode::ShellsRole() { return "shells"; }
const char* vtkMRMLFuchsTetrahedralizerNode::AmbientTetrahedraRole() { return "ambientTetrahedra"; }
const char* vtkMRMLFuchsTetrahedralizerNode::QualityTableRole() { return "qualityTable"; }
const char* vtkMRMLFuchsTetrahedralizerNode::HistogramRole() { return "histogram"; }

vtkMRMLFuchsTetrahedralizerNode::vtkMRMLFuchsTetrahedralizerNode()
{
  this->HideFromEditors = 1;
  for (const char* role : { SurfaceRole(), ScaleRole(), TargetRole(), PathRole(), MeshRole(), ParentMeshRole(),
                            ChildMeshRole(), ShellsRole() })
  {
    this->AddNodeReferenceRole(role, (std::string(role) + "NodeRef").c_str());
  }
}

void vtkMRMLFuchsTetrahedralizerNode::ReadXMLAttributes(const char** atts)
{
  const int wasModifying = this->StartModify();
  Superclass::ReadXMLAttributes(atts);
  vtkMRMLReadXMLBeginMacro(atts);
  vtkMRMLReadXMLEnumMacro(edgeLengthSource, EdgeLengthSource);
  vtkMRMLReadXMLFloatMacro(edgeLength, EdgeLength);
  vtkMRMLReadXMLBooleanMacro(useAmbient, UseAmbient);
  vtkMRMLReadXMLStdStringMacro(shellTissues, ShellTissues);
  vtkMRMLReadXMLFloatMacro(shellThickness, ShellThickness);
  vtkMRMLReadXMLStdStringMacro(materialsFile, MaterialsFile);
  vtkMRMLReadXMLFloatMacro(nonlinearDistance, NonlinearDistance);
  vtkMRMLReadXMLFloatMacro(nullDisplacementRadius, NullDisplacementRadius);
  vtkMRMLReadXMLFloatMacro(nullDisplacementPathDistance, NullDisplacementPathDistance);
  vtkMRMLReadXMLFloatMacro(nullDisplacementPathDistanceAtTarget, NullDisplacementPathDistanceAtTarget);
  vtkMRMLReadXMLBooleanMacro(conditioning, Conditioning);
  vtkMRMLReadXMLIntMacro(threads, Threads);
  vtkMRMLReadXMLEnumMacro(colorBy, ColorBy);
  vtkMRMLReadXMLEnumMacro(clipPlane, ClipPlane);
  vtkMRMLReadXMLBooleanMacro(clipFlipped, ClipFlipped);
  vtkMRMLReadXMLBooleanMacro(showEdges, ShowEdges);
  vtkMRMLReadXMLEndMacro();
  this->EndModify(wasModifying);
}

void vtkMRMLFuchsTetrahedralizerNode::WriteXML(ostream& of, int indent)
{
  Superclass::WriteXML(of, indent);
  const std::streamsize precision = of.precision(15); // lengths come back as they were
  vtkMRMLWriteXMLBeginMacro(of);
  vtkMRMLWriteXMLEnumMacro(edgeLengthSource, EdgeLengthSource);
  vtkMRMLWriteXMLFloatMacro(edgeLength, EdgeLength);
  vtkMRMLWriteXMLBooleanMacro(useAmbient, UseAmbient);
  vtkMRMLWriteXMLStdStringMacro(shellTissues, ShellTissues);
  vtkMRMLWriteXMLFloatMacro(shellThickness, ShellThickness);
  vtkMRMLWriteXMLStdStringMacro(materialsFile, MaterialsFile);
  vtkMRMLWriteXMLFloatMacro(nonlinearDistance, NonlinearDistance);
  vtkMRMLWriteXMLFloatMacro(nullDisplacementRadius, NullDisplacementRadius);
  vtkMRMLWriteXMLFloatMacro(nullDisplacementPathDistance, NullDisplacementPathDistance);
  vtkMRMLWriteXMLFloatMacro(nullDisplacementPathDistanceAtTarget, NullDisplacementPathDistanceAtTarget);
  vtkMRMLWriteXMLBooleanMacro(conditioning, Conditioning);
  vtkMRMLWriteXMLIntMacro(threads, Threads);
  vtkMRMLWriteXMLEnumMacro(colorBy, ColorBy);
  vtkMRMLWriteXMLEnumMacro(clipPlane, ClipPlane);
  vtkMRMLWriteXMLBooleanMacro(clipFlipped, ClipFlipped);
  vtkMRMLWriteXMLBooleanMacro(showEdges, ShowEdges);
  vtkMRMLWriteXMLEndMacro();
  of.precision(precision);
}

void vtkMRMLFuchsTetrahedralizerNode::CopyContent(vtkMRMLNode* node, bool deepCopy)
{
  MRMLNodeModifyBlocker blocker(this);
  Superclass::CopyContent(node, deepCopy);
  vtkMRMLCopyBeginMacro(node);
  vtkMRMLCopyIntMacro(EdgeLengthSource);
  vtkMRMLCopyFloatMacro(EdgeLength);
  vtkMRMLCopyBooleanMacro(UseAmbient);
  vtkMRMLCopyStdStringMacro(ShellTissues);
  vtkMRMLCopyFloatMacro(ShellThickness);
  vtkMRMLCopyStdStringMacro(MaterialsFile);
  vtkMRMLCopyFloatMacro(NonlinearDistance);
  vtkMRMLCopyFloatMacro(NullDisplacementRadius);
  vtkMRMLCopyFloatMacro(NullDisplacementPathDistance);
  vtkMRMLCopyFloatMacro(NullDisplacementPathDistanceAtTarget);
  vtkMRMLCopyBooleanMacro(Conditioning);
  vtkMRMLCopyIntMacro(Threads);
  vtkMRMLCopyIntMacro(ColorBy);
  vtkMRMLCopyIntMacro(ClipPlane);
  vtkMRMLCopyBooleanMacro(ClipFlipped);
  vtkMRMLCopyBooleanMacro(ShowEdges);
  vtkMRMLCopyEndMacro();
}

void vtkMRMLFuchsTetrahedralizerNode::PrintSelf(ostream& os, vtkIndent indent)
{
  Superclass::PrintSelf(os, indent);
  vtkMRMLPrintBeginMacro(os, indent);
  vtkMRMLPrintEnumMacro(EdgeLengthSource);
  vtkMRMLPrintFloatMacro(EdgeLength);
  vtkMRMLPrintBooleanMacro(UseAmbient);
  vtkMRMLPrintStdStringMacro(ShellTissues);
  vtkMRMLPrintFloatMacro(ShellThickness);
  vtkMRMLPrintStdStringMacro(MaterialsFile);
  vtkMRMLPrintFloatMacro(NonlinearDistance);
  vtkMRMLPrintFloatMacro(NullDisplacementRadius);
  vtkMRMLPrintFloatMacro(NullDisplacementPathDistance);
  vtkMRMLPrintFloatMacro(NullDisplacementPathDistanceAtTarget);
  vtkMRMLPrintBooleanMacro(Conditioning);
  vtkMRMLPrintIntMacro(Threads);
  vtkMRMLPrintEnumMacro(ColorBy);
  vtkMRMLPrintEnumMacro(ClipPlane);
  vtkMRMLPrintBooleanMacro(ClipFlipped);
  vtkMRMLPrintBooleanMacro(ShowEdges);
  vtkMRMLPrintEndMacro();
}

void vtkMRMLFuchsTetrahedralizerNode::SetNode(const char* role, vtkMRMLNode* node)
{
  this->SetNodes(role, node ? std::vector<vtkMRMLNode*>{ node } : std::vector<vtkMRMLNode*>{});
}

void vtkMRMLFuchsTetrahedralizerNode::SetNodes(const char* role, const std::vector<vtkMRMLNode*>& nodes)
{
  if (this->GetNodes(role) == nodes) return;
  MRMLNodeModifyBlocker blocker(this);
  this->RemoveNodeReferenceIDs(role);
  for (vtkMRMLNode* node : nodes) this->AddNodeReferenceID(role, node->GetID());
  this->Modified();
}

std::vector<vtkMRMLNode*> vtkMRMLFuchsTetrahedralizerNode::GetNodes(const char* role)
{
  std::vector<vtkMRMLNode*> nodes;
  for (int i = 0; i < this->GetNumberOfNodeReferences(role); ++i)
  {
    if (vtkMRMLNode* node = this->GetNthNodeReference(role, i)) nodes.push_back(node);
  }
  return nodes;
}

vtkMRMLModelNode* vtkMRMLFuchsTetrahedralizerNode::GetModelNode(const char* role)
{
  return vtkMRMLModelNode::SafeDownCast(this->GetNodeReference(role));
}

void vtkMRMLFuchsTetrahedralizerNode::SetEdgeLengthSource(int source)
{
  if (source < 0 || source >= EdgeLengthSource_Last || source == this->EdgeLengthSource) return;
  this->EdgeLengthSource = source;
  this->Modified();
}

const char* vtkMRMLFuchsTetrahedralizerNode::GetEdgeLengthSourceAsString(int source)
{
  return nameAt(edgeLengthSources, source);
}

int vtkMRMLFuchsTetrahedralizerNode::GetEdgeLengthSourceFromString(const char* name)
{
  return indexOf(edgeLengthSources, name);
}

void vtkMRMLFuchsTetrahedralizerNode::SetColorBy(int colorBy)
{
  if (colorBy < 0 || colorBy >= ColorBy_Last || colorBy == this->ColorBy) return;
  this->ColorBy = colorBy;
  this->Modified();
}

const char* vtkMRMLFuchsTetrahedralizerNode::GetColorByAsString(int colorBy) { return nameAt(colors, colorBy); }

int vtkMRMLFuchsTetrahedralizerNode::GetColorByFromString(const char* name) { return indexOf(colors, name); }

void vtkMRMLFuchsTetrahedralizerNode::SetClipPlane(int plane)
{
  if (plane < 0 || plane >= ClipPlane_Last || plane == this->ClipPlane) return;
  this->ClipPlane = plane;
  this->Modified();
}

const char* vtkMRMLFuchsTetrahedralizerNode::GetClipPlaneAsString(int plane) { return nameAt(planes, plane); }

int vtkMRMLFuchsTetrahedralizerNode::GetClipPlaneFromString(const char* name) { return indexOf(planes, name); }
