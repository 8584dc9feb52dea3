// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Base of the modules' parameter nodes. A derived class lists its values and its roles once; reading, writing, copying
/// and printing follow from the lists.

#include "vtkSurgicalMesherSupportMRMLExport.h"

#include <vtkMRMLNode.h>

#include <functional>
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

class vtkMRMLLabelMapVolumeNode;
class vtkMRMLModelNode;
class vtkMRMLPlotChartNode;
class vtkMRMLScalarVolumeNode;
class vtkMRMLTableNode;

class VTK_SURGICALMESHER_SUPPORT_MRML_EXPORT vtkMRMLSurgicalMesherParameterNode : public vtkMRMLNode
{
public:
  vtkAbstractTypeMacro(vtkMRMLSurgicalMesherParameterNode, vtkMRMLNode);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  void ReadXMLAttributes(const char** atts) override;
  void WriteXML(ostream& of, int indent) override;
  void CopyContent(vtkMRMLNode* node, bool deepCopy = true) override;

  /// Refers to `node`, which may be null, in `role`, and to no other.
  void SetNode(const char* role, vtkMRMLNode* node);
  void SetNodes(const char* role, const std::vector<vtkMRMLNode*>& nodes);
  /// Those that are in the scene.
  std::vector<vtkMRMLNode*> GetNodes(const char* role);
  /// The first node of a role; null if there is none, or if it is of another class.
  vtkMRMLModelNode* GetModelNode(const char* role);
  vtkMRMLScalarVolumeNode* GetScalarVolumeNode(const char* role);
  vtkMRMLLabelMapVolumeNode* GetLabelMapNode(const char* role);
  vtkMRMLTableNode* GetTableNode(const char* role);
  vtkMRMLPlotChartNode* GetPlotChartNode(const char* role);

protected:
  vtkMRMLSurgicalMesherParameterNode() { this->HideFromEditors = 1; }
  ~vtkMRMLSurgicalMesherParameterNode() override = default;
  vtkMRMLSurgicalMesherParameterNode(const vtkMRMLSurgicalMesherParameterNode&) = delete;
  void operator=(const vtkMRMLSurgicalMesherParameterNode&) = delete;

  /// A value that is one of several, each with a name in the scene's file.
  struct Choice
  {
    int* index;
    std::vector<const char*> names;
  };
  /// A value of a type of its own, in the scene's file as text.
  struct Text
  {
    std::function<std::string()> get;
    std::function<void(const std::string&)> set;
  };
  /// A member of the node; scenes that are saved know it as `attribute`.
  struct Value
  {
    const char* attribute;
    std::variant<bool*, int*, double*, std::string*, Choice, Text> member;
  };
  virtual std::vector<Value> GetValues() = 0;

  /// Scenes that are saved know each role by its name and `suffix`. Of their nodes these `events` are observed.
  void AddRoles(std::initializer_list<const char*> roles, const std::string& suffix,
                std::initializer_list<int> events = {});

private:
  static std::string TextOf(const Value& value);
  void ReadValue(const Value& value, const std::string& text);
};
