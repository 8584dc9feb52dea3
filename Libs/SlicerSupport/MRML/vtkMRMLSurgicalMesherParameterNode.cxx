// SPDX-License-Identifier: Apache-2.0
#include "vtkMRMLSurgicalMesherParameterNode.h"

#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLTableNode.h>

#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkVariant.h>

#include <algorithm>
#include <locale>
#include <sstream>

namespace
{

template <class... Visitors>
struct Overloaded : Visitors...
{
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

} // namespace

/// Returns the text stored in the scene file, before special characters are encoded as entities.
std::string vtkMRMLSurgicalMesherParameterNode::TextOf(const Value& value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(15); // lengths are restored exactly
  std::visit(Overloaded{ [&](const bool* member) { text << (*member ? "true" : "false"); },
                         [&](const Choice& choice) { text << choice.names[*choice.index]; },
                         [&](const Text& access) { text << access.get(); },
                         [&](const auto* member) { text << *member; } },
             value.member);
  return text.str();
}

void vtkMRMLSurgicalMesherParameterNode::ReadValue(const Value& value, const std::string& text)
{
  bool isValid = true;
  const auto assign = [&isValid](auto* member, auto read)
  {
    if (isValid) *member = read;
  };
  std::visit(Overloaded{ [&](bool* member) { *member = text == "true"; },
                         [&](int* member) { assign(member, vtkVariant(text).ToInt(&isValid)); },
                         [&](double* member) { assign(member, vtkVariant(text).ToDouble(&isValid)); },
                         [&](std::string* member) { *member = text; },
                         [&](const Choice& choice)
                         {
                           const auto found = std::find(choice.names.begin(), choice.names.end(), text);
                           isValid = found != choice.names.end();
                           assign(choice.index, int(found - choice.names.begin()));
                         },
                         [&](const Text& access) { access.set(text); } },
             value.member);
  if (!isValid) vtkErrorMacro("Failed to read " << value.attribute << " attribute value from string '" << text << "'");
}

void vtkMRMLSurgicalMesherParameterNode::ReadXMLAttributes(const char** atts)
{
  MRMLNodeModifyBlocker blocker(this);
  this->Superclass::ReadXMLAttributes(atts);
  const std::vector<Value> values = this->GetValues();
  for (; atts[0] && atts[1]; atts += 2)
  {
    for (const Value& value : values)
    {
      if (std::string(value.attribute) == atts[0]) this->ReadValue(value, atts[1]);
    }
  }
  this->Modified();
}

void vtkMRMLSurgicalMesherParameterNode::WriteXML(ostream& of, int indent)
{
  this->Superclass::WriteXML(of, indent);
  for (const Value& value : this->GetValues())
    of << " " << value.attribute << "=\"" << XMLAttributeEncodeString(TextOf(value)) << "\"";
}

void vtkMRMLSurgicalMesherParameterNode::CopyContent(vtkMRMLNode* node, bool deepCopy)
{
  MRMLNodeModifyBlocker blocker(this);
  this->Superclass::CopyContent(node, deepCopy);
  if (!node || !node->IsA(this->GetClassName()))
  {
    vtkErrorMacro("Copy failed: invalid source node");
    return;
  }
  const std::vector<Value> from = static_cast<vtkMRMLSurgicalMesherParameterNode*>(node)->GetValues();
  const std::vector<Value> to = this->GetValues();
  for (std::size_t i = 0; i < to.size(); ++i)
  {
    std::visit(Overloaded{ [](const Choice& a, const Choice& b) { *b.index = *a.index; },
                           [](const Text& a, const Text& b) { b.set(a.get()); },
                           [](auto* a, auto* b)
                           {
                             if constexpr (std::is_same_v<decltype(a), decltype(b)>) *b = *a;
                           },
                           [](const auto&, const auto&) {} },
               from[i].member, to[i].member);
  }
  this->Modified();
}

void vtkMRMLSurgicalMesherParameterNode::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const Value& value : this->GetValues()) os << indent << value.attribute << ": " << TextOf(value) << "\n";
}

void vtkMRMLSurgicalMesherParameterNode::AddRoles(std::initializer_list<const char*> roles, const std::string& suffix,
                                                  std::initializer_list<int> events)
{
  vtkNew<vtkIntArray> observed;
  for (const int event : events) observed->InsertNextValue(event);
  for (const std::string role : roles) this->AddNodeReferenceRole(role.c_str(), (role + suffix).c_str(), observed);
}

void vtkMRMLSurgicalMesherParameterNode::SetNode(const char* role, vtkMRMLNode* node)
{
  this->SetNodes(role, node ? std::vector<vtkMRMLNode*>{ node } : std::vector<vtkMRMLNode*>{});
}

void vtkMRMLSurgicalMesherParameterNode::SetNodes(const char* role, const std::vector<vtkMRMLNode*>& nodes)
{
  // A reference may be to a removed node.
  const bool hasLeft = this->GetNumberOfNodeReferences(role) != int(nodes.size());
  if (!hasLeft && this->GetNodes(role) == nodes) return;
  MRMLNodeModifyBlocker blocker(this);
  this->RemoveNodeReferenceIDs(role);
  for (vtkMRMLNode* node : nodes) this->AddNodeReferenceID(role, node->GetID());
  this->Modified();
}

std::vector<vtkMRMLNode*> vtkMRMLSurgicalMesherParameterNode::GetNodes(const char* role)
{
  std::vector<vtkMRMLNode*> nodes;
  for (int i = 0; i < this->GetNumberOfNodeReferences(role); ++i)
  {
    if (vtkMRMLNode* node = this->GetNthNodeReference(role, i)) nodes.push_back(node);
  }
  return nodes;
}

vtkMRMLModelNode* vtkMRMLSurgicalMesherParameterNode::GetModelNode(const char* role)
{
  return vtkMRMLModelNode::SafeDownCast(this->GetNodeReference(role));
}

vtkMRMLScalarVolumeNode* vtkMRMLSurgicalMesherParameterNode::GetScalarVolumeNode(const char* role)
{
  return vtkMRMLScalarVolumeNode::SafeDownCast(this->GetNodeReference(role));
}

vtkMRMLLabelMapVolumeNode* vtkMRMLSurgicalMesherParameterNode::GetLabelMapNode(const char* role)
{
  return vtkMRMLLabelMapVolumeNode::SafeDownCast(this->GetNodeReference(role));
}

vtkMRMLTableNode* vtkMRMLSurgicalMesherParameterNode::GetTableNode(const char* role)
{
  return vtkMRMLTableNode::SafeDownCast(this->GetNodeReference(role));
}

vtkMRMLPlotChartNode* vtkMRMLSurgicalMesherParameterNode::GetPlotChartNode(const char* role)
{
  return vtkMRMLPlotChartNode::SafeDownCast(this->GetNodeReference(role));
}
