// SPDX-License-Identifier: Apache-2.0
#include "vtkMRMLSurgicalPathScaleNode.h"

#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsCurveNode.h>
#include <vtkMRMLMarkupsLineNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLTransformableNode.h>
#include <vtkSegmentation.h>

#include <vtkIntArray.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

#include <initializer_list>

namespace
{

bool isPath(vtkMRMLMarkupsNode* node)
{
  return vtkMRMLMarkupsCurveNode::SafeDownCast(node) || vtkMRMLMarkupsLineNode::SafeDownCast(node);
}

vtkSmartPointer<vtkIntArray> makeEvents(std::initializer_list<int> list)
{
  auto events = vtkSmartPointer<vtkIntArray>::New();
  for (int event : list) events->InsertNextValue(event);
  return events;
}

} // namespace

vtkMRMLNodeNewMacro(vtkMRMLSurgicalPathScaleNode);

const char* vtkMRMLSurgicalPathScaleNode::TissueMapRole() { return "tissueMap"; }
const char* vtkMRMLSurgicalPathScaleNode::TargetsRole() { return "targets"; }
const char* vtkMRMLSurgicalPathScaleNode::PathRole() { return "path"; }
const char* vtkMRMLSurgicalPathScaleNode::FurtherMarkupsRole() { return "furtherMarkups"; }
const char* vtkMRMLSurgicalPathScaleNode::ScaleRole() { return "scale"; }
const char* vtkMRMLSurgicalPathScaleNode::OutputLabelMapRole() { return "outputLabelMap"; }
const char* vtkMRMLSurgicalPathScaleNode::ProfileChartRole() { return "profileChart"; }

//----------------------------------------------------------------------------
vtkMRMLSurgicalPathScaleNode::vtkMRMLSurgicalPathScaleNode()
{
  this->SetHideFromEditors(true);
  this->AddNodeReferenceRole(
    TissueMapRole(), TissueMapRole(),
    makeEvents({ vtkMRMLTransformableNode::TransformModifiedEvent, vtkMRMLVolumeNode::ImageDataModifiedEvent,
                 vtkSegmentation::SegmentAdded, vtkSegmentation::SegmentRemoved, vtkSegmentation::SegmentModified,
                 vtkSegmentation::ContainedRepresentationNamesModified, vtkSegmentation::RepresentationModified,
                 vtkSegmentation::SegmentsOrderModified }));
  for (const char* role : { TargetsRole(), PathRole(), FurtherMarkupsRole() })
  {
    this->AddNodeReferenceRole(
      role, role,
      makeEvents({ vtkMRMLTransformableNode::TransformModifiedEvent, vtkMRMLMarkupsNode::PointModifiedEvent,
                   vtkMRMLMarkupsNode::PointAddedEvent, vtkMRMLMarkupsNode::PointRemovedEvent }));
  }
  for (const char* role : { ScaleRole(), OutputLabelMapRole(), ProfileChartRole() })
    this->AddNodeReferenceRole(role, role);
}

void vtkMRMLSurgicalPathScaleNode::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkMRMLPrintBeginMacro(os, indent);
  vtkMRMLPrintFloatMacro(MinimumEdgeLength);
  vtkMRMLPrintFloatMacro(MaximumEdgeLength);
  vtkMRMLPrintFloatMacro(ChildRadius);
  vtkMRMLPrintFloatMacro(DecayLength);
  vtkMRMLPrintFloatMacro(Spacing);
  vtkMRMLPrintFloatMacro(PathChildRadius);
  vtkMRMLPrintFloatMacro(PathDecayLength);
  vtkMRMLPrintFloatMacro(Gradation);
  vtkMRMLPrintStdStringMacro(Combine);
  vtkMRMLPrintStdStringMacro(TissueLengths);
  vtkMRMLPrintFloatMacro(NullDisplacementRadius);
  vtkMRMLPrintFloatMacro(NullDisplacementPathDistance);
  vtkMRMLPrintFloatMacro(NullDisplacementPathDistanceAtTarget);
  vtkMRMLPrintStdStringMacro(NullDisplacementTissues);
  vtkMRMLPrintEndMacro();
}

void vtkMRMLSurgicalPathScaleNode::ReadXMLAttributes(const char** atts)
{
  MRMLNodeModifyBlocker blocker(this);
  this->Superclass::ReadXMLAttributes(atts);
  vtkMRMLReadXMLBeginMacro(atts);
  vtkMRMLReadXMLFloatMacro(minimumEdgeLength, MinimumEdgeLength);
  vtkMRMLReadXMLFloatMacro(maximumEdgeLength, MaximumEdgeLength);
  vtkMRMLReadXMLFloatMacro(childRadius, ChildRadius);
  vtkMRMLReadXMLFloatMacro(decayLength, DecayLength);
  vtkMRMLReadXMLFloatMacro(spacing, Spacing);
  vtkMRMLReadXMLFloatMacro(pathChildRadius, PathChildRadius);
  vtkMRMLReadXMLFloatMacro(pathDecayLength, PathDecayLength);
  vtkMRMLReadXMLFloatMacro(gradation, Gradation);
  vtkMRMLReadXMLStdStringMacro(combine, Combine);
  vtkMRMLReadXMLStdStringMacro(tissueLengths, TissueLengths);
  vtkMRMLReadXMLFloatMacro(nullDisplacementRadius, NullDisplacementRadius);
  vtkMRMLReadXMLFloatMacro(nullDisplacementPathDistance, NullDisplacementPathDistance);
  vtkMRMLReadXMLFloatMacro(nullDisplacementPathDistanceAtTarget, NullDisplacementPathDistanceAtTarget);
  vtkMRMLReadXMLStdStringMacro(nullDisplacementTissues, NullDisplacementTissues);
  vtkMRMLReadXMLEndMacro();
}

void vtkMRMLSurgicalPathScaleNode::WriteXML(ostream& of, int indent)
{
  this->Superclass::WriteXML(of, indent);
  const std::streamsize precision = of.precision(15);
  vtkMRMLWriteXMLBeginMacro(of);
  vtkMRMLWriteXMLFloatMacro(minimumEdgeLength, MinimumEdgeLength);
  vtkMRMLWriteXMLFloatMacro(maximumEdgeLength, MaximumEdgeLength);
  vtkMRMLWriteXMLFloatMacro(childRadius, ChildRadius);
  vtkMRMLWriteXMLFloatMacro(decayLength, DecayLength);
  vtkMRMLWriteXMLFloatMacro(spacing, Spacing);
  vtkMRMLWriteXMLFloatMacro(pathChildRadius, PathChildRadius);
  vtkMRMLWriteXMLFloatMacro(pathDecayLength, PathDecayLength);
  vtkMRMLWriteXMLFloatMacro(gradation, Gradation);
  vtkMRMLWriteXMLStdStringMacro(combine, Combine);
  vtkMRMLWriteXMLStdStringMacro(tissueLengths, TissueLengths);
  vtkMRMLWriteXMLFloatMacro(nullDisplacementRadius, NullDisplacementRadius);
  vtkMRMLWriteXMLFloatMacro(nullDisplacementPathDistance, NullDisplacementPathDistance);
  vtkMRMLWriteXMLFloatMacro(nullDisplacementPathDistanceAtTarget, NullDisplacementPathDistanceAtTarget);
  vtkMRMLWriteXMLStdStringMacro(nullDisplacementTissues, NullDisplacementTissues);
  vtkMRMLWriteXMLEndMacro();
  of.precision(precision);
}

void vtkMRMLSurgicalPathScaleNode::CopyContent(vtkMRMLNode* node, bool deepCopy)
{
  MRMLNodeModifyBlocker blocker(this);
  this->Superclass::CopyContent(node, deepCopy);
  vtkMRMLCopyBeginMacro(node);
  vtkMRMLCopyFloatMacro(MinimumEdgeLength);
  vtkMRMLCopyFloatMacro(MaximumEdgeLength);
  vtkMRMLCopyFloatMacro(ChildRadius);
  vtkMRMLCopyFloatMacro(DecayLength);
  vtkMRMLCopyFloatMacro(Spacing);
  vtkMRMLCopyFloatMacro(PathChildRadius);
  vtkMRMLCopyFloatMacro(PathDecayLength);
  vtkMRMLCopyFloatMacro(Gradation);
  vtkMRMLCopyStdStringMacro(Combine);
  vtkMRMLCopyStdStringMacro(TissueLengths);
  vtkMRMLCopyFloatMacro(NullDisplacementRadius);
  vtkMRMLCopyFloatMacro(NullDisplacementPathDistance);
  vtkMRMLCopyFloatMacro(NullDisplacementPathDistanceAtTarget);
  vtkMRMLCopyStdStringMacro(NullDisplacementTissues);
  vtkMRMLCopyEndMacro();
}

void vtkMRMLSurgicalPathScaleNode::ProcessMRMLEvents(vtkObject* caller, unsigned long event, void* callData)
{
  this->Superclass::ProcessMRMLEvents(caller, event, callData);
  if (this->GetScene() && caller != this->GetScene()) this->InvokeEvent(InputModifiedEvent);
}

//----------------------------------------------------------------------------
vtkMRMLNode* vtkMRMLSurgicalPathScaleNode::GetTissueMapNode() { return this->GetNodeReference(TissueMapRole()); }

std::vector<vtkMRMLMarkupsNode*> vtkMRMLSurgicalPathScaleNode::GetTargetNodes()
{
  std::vector<vtkMRMLMarkupsNode*> nodes;
  auto* targets = vtkMRMLMarkupsNode::SafeDownCast(this->GetNodeReference(TargetsRole()));
  if (targets) nodes.push_back(targets);
  for (int n = 0; n < this->GetNumberOfNodeReferences(FurtherMarkupsRole()); ++n)
  {
    auto* node = vtkMRMLMarkupsNode::SafeDownCast(this->GetNthNodeReference(FurtherMarkupsRole(), n));
    if (node && !isPath(node)) nodes.push_back(node);
  }
  return nodes;
}

std::vector<vtkMRMLMarkupsNode*> vtkMRMLSurgicalPathScaleNode::GetPathNodes()
{
  std::vector<vtkMRMLMarkupsNode*> nodes;
  auto* path = vtkMRMLMarkupsNode::SafeDownCast(this->GetNodeReference(PathRole()));
  if (path) nodes.push_back(path);
  for (int n = 0; n < this->GetNumberOfNodeReferences(FurtherMarkupsRole()); ++n)
  {
    auto* node = vtkMRMLMarkupsNode::SafeDownCast(this->GetNthNodeReference(FurtherMarkupsRole(), n));
    if (node && isPath(node)) nodes.push_back(node);
  }
  return nodes;
}

vtkMRMLScalarVolumeNode* vtkMRMLSurgicalPathScaleNode::GetScaleNode()
{
  return vtkMRMLScalarVolumeNode::SafeDownCast(this->GetNodeReference(ScaleRole()));
}

vtkMRMLLabelMapVolumeNode* vtkMRMLSurgicalPathScaleNode::GetOutputLabelMapNode()
{
  return vtkMRMLLabelMapVolumeNode::SafeDownCast(this->GetNodeReference(OutputLabelMapRole()));
}

vtkMRMLPlotChartNode* vtkMRMLSurgicalPathScaleNode::GetProfileChartNode()
{
  return vtkMRMLPlotChartNode::SafeDownCast(this->GetNodeReference(ProfileChartRole()));
}

void vtkMRMLSurgicalPathScaleNode::SetNode(const char* role, vtkMRMLNode* node)
{
  this->SetAndObserveNodeReferenceID(role, node ? node->GetID() : nullptr);
}

void vtkMRMLSurgicalPathScaleNode::SetFurtherMarkups(const std::vector<vtkMRMLNode*>& nodes)
{
  MRMLNodeModifyBlocker blocker(this);
  this->RemoveNodeReferenceIDs(FurtherMarkupsRole());
  for (vtkMRMLNode* node : nodes) this->AddAndObserveNodeReferenceID(FurtherMarkupsRole(), node->GetID());
}

bool vtkMRMLSurgicalPathScaleNode::WantsNullDisplacement() const
{
  return this->NullDisplacementRadius > 0 || this->NullDisplacementPathDistance > 0;
}
