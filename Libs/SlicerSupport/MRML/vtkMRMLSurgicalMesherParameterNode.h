// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Base class of the modules' parameter nodes. A derived class lists its values and roles once; reading, writing,
/// copying and printing are derived from these lists.

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

  /// Makes `node`, which may be null, the only node of `role`.
  void SetNode(const char* role, vtkMRMLNode* node);
  void SetNodes(const char* role, const std::vector<vtkMRMLNode*>& nodes);
  /// Returns the nodes of a role that are in the scene.
  std::vector<vtkMRMLNode*> GetNodes(const char* role);
  /// Returns the first node of a role; null if there is none or it has another class.
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

  /// A value out of several, each with a name in the scene file.
  struct Choice
  {
    int* index;
    std::vector<const char*> names;
  };
  /// A value of a custom type, stored in the scene file as text.
  struct Text
  {
    std::function<std::string()> get;
    std::function<void(const std::string&)> set;
  };
  /// A member of the node, stored in scenes as `attribute`.
  struct Value
  {
    const char* attribute;
    std::variant<bool*, int*, double*, std::string*, Choice, Text> member;
  };
  virtual std::vector<Value> GetValues() = 0;

  /// Adds roles, stored in scenes by name and `suffix`, whose nodes are observed for `events`.
  void AddRoles(std::initializer_list<const char*> roles, const std::string& suffix,
                std::initializer_list<int> events = {});

private:
  static std::string TextOf(const Value& value);
  void ReadValue(const Value& value, const std::string& text);
};
